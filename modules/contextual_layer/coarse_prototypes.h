// Prototypes rounded to 64 to 32,767 levels: approximate distances in a fifth of the time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "modules/contextual_layer/cell_list.h"

namespace forage::contextual {

constexpr Index lanes = 16;  ///< prototypes per block; cell i of all of them is contiguous in memory

/// Prototypes of N cells between 0 and 1, in blocks of slots. The number of levels is the largest for which
/// the sum over all cells fits into 16 bits: 1,365 for 48 cells.
class CoarsePrototypes {
  public:
    CoarsePrototypes() = default;
    CoarsePrototypes(Index blocks, Index cells);

    /// An upper bound of the error of an estimated distance, compared with the exact sum and with a sum that
    /// is rounded to single precision for each cell. It includes the rounding errors of LongTermMemory.
    float error() const { return error_; }
    /// Whether estimates are accurate enough to save time. With many cells there are too few levels.
    bool useful() const { return levels_ >= min_levels; }

    /// Stores cell `i` of a prototype.
    void put(Index slot, Index i, double cell) { blocks_[index(slot, i)] = level(cell); }
    /// The largest value of a cell of the present prototype. It exceeds 1 because the divisor was rounded.
    static constexpr double max_cell = 1.000001;
    /// Sets the prototype that the stored ones are compared with. Its cells must be in 0..max_cell.
    void compare_with(const Eigen::Ref<const Eigen::ArrayXd>& present);
    /// Estimates the mean of |stored - present| over the cells for two blocks of prototypes:
    /// distances[0..lanes) and distances[lanes..2 lanes).
    void estimate(Index first, Index second, const CellList& cells, float* distances) const;

  private:
    static constexpr int min_levels = 64;

    std::size_t index(Index slot, Index i) const {
        return static_cast<std::size_t>((slot / lanes * cells_ + i) * lanes + slot % lanes);
    }
    std::int16_t level(double cell) const {
        return static_cast<std::int16_t>(cell * levels_ +
                                         0.5);  // rounds to the nearest, as `cell` is not negative
    }

    Index cells_ = 0;
    int levels_ = 0;
    float error_ = 0;
    std::vector<std::int16_t> blocks_;   ///< [block][cell][lane]
    std::vector<std::int16_t> present_;  ///< [cell]
};

}  // namespace forage::contextual
