// Which cells of a comparison are not 0 on both sides.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace forage::contextual {

using Eigen::Index;

constexpr Index cells_per_word = 64;  ///< of a bit per cell

/// The cells that count in a comparison, in order, and perhaps some more.
class CellList {
  public:
    CellList() = default;
    explicit CellList(Index cells);

    /// Lists the cells of which a bit is set in one of the three. As what is 0 on both sides adds nothing,
    /// cells that were listed before may stay, until they have cost about as much as a new list.
    void list(const std::uint64_t* first, const std::uint64_t* second, const std::uint64_t* present);

    const Index* begin() const { return cells_.data(); }
    Index size() const { return size_; }

  private:
    std::vector<std::uint64_t> of_;  ///< a bit per cell
    std::vector<Index> cells_;
    Index size_ = 0, in_vain_ = 0;  ///< in_vain_: cells that added nothing, since the list was made
};

}  // namespace forage::contextual
