// The cells of a comparison of prototypes that are not 0 on both sides.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace forage::contextual {

using Eigen::Index;

constexpr Index cells_per_word = 64;  ///< cells per word of a bit set with one bit per cell

/// The cells that contribute to a comparison, in ascending order, and possibly some that do not.
class CellList {
  public:
    CellList() = default;
    explicit CellList(Index cells);

    /// Lists the cells whose bit is set in at least one of three bit sets. Cells that are 0 on both sides
    /// contribute nothing; therefore cells of the previous list may stay, until they have cost about as much
    /// time as a new list.
    void list(const std::uint64_t* first, const std::uint64_t* second, const std::uint64_t* present);

    const Index* begin() const { return cells_.data(); }
    Index size() const { return size_; }

  private:
    std::vector<std::uint64_t> of_;  ///< the listed cells as a bit set
    std::vector<Index> cells_;
    Index size_ = 0;
    Index wasted_ = 0;  ///< number of cells compared without need since the list was made
};

}  // namespace forage::contextual
