// Prototypes to the nearest of 64 to 32,767 levels: nearly their distances, in a fifth of the time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "modules/contextual_layer/cell_list.h"

namespace forage::contextual {

constexpr Index lanes = 16;  ///< prototypes per block: cell i of all lies side by side

/// Slots for prototypes of N cells between 0 and 1, in blocks. Levels are so many that the sum over all cells
/// fits into 16 bits: 1,365 for 48 cells.
class CoarsePrototypes {
  public:
    CoarsePrototypes() = default;
    CoarsePrototypes(Index blocks, Index cells);

    /// What an estimated distance is off at most, of the exact sum or of one that is rounded to single
    /// precision for each cell; with something to spare for what is then made of both in single precision.
    float error() const { return error_; }
    /// Whether estimates spare anything: with many cells there are few levels.
    bool useful() const { return levels_ >= least_levels; }

    /// Stores the i-th cell of a prototype.
    void put(Index slot, Index i, double cell) { blocks_[place(slot, i)] = level(cell); }
    /// The most that a cell of the present prototype may be: the maximum that it is divided by was rounded.
    static constexpr double most = 1.000001;
    /// Takes the prototype that others are compared with, of cells from 0 to `most`.
    void compare_with(const Eigen::Ref<const Eigen::ArrayXd>& present);
    /// distances[0..lanes) and [lanes..2 lanes): of the prototypes of two blocks, mean of |stored - present|.
    void estimate(Index first, Index second, const CellList& cells, float* distances) const;

  private:
    static constexpr int least_levels = 64;

    std::size_t place(Index slot, Index i) const {
        return static_cast<std::size_t>((slot / lanes * cells_ + i) * lanes + slot % lanes);
    }
    std::int16_t level(double cell) const {
        return static_cast<std::int16_t>(cell * levels_ + 0.5);  // from 0 on: rounded to the nearest
    }

    Index cells_ = 0;
    int levels_ = 0;
    float error_ = 0;
    std::vector<std::int16_t> blocks_;   ///< [block][cell][lane]
    std::vector<std::int16_t> present_;  ///< [cell]
};

}  // namespace forage::contextual
