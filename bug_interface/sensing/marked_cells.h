// Marked cells of a grid: does a rectangle hold one?
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace forage::bug {

/// One bit per cell, in blocks of 8 x 8, and sums over the blocks that hold any. Of a picture of 2000 x 2000
/// it takes 0.75 MB and stays in the cache.
class MarkedCells {
  public:
    MarkedCells() = default;
    /// `marks(column, row, count)` tells of up to 8 cells of a row, from this column on, which are marked:
    /// the lowest bit is of the first.
    template <class Marks>
    MarkedCells(std::size_t columns, std::size_t rows, Marks marks);

    /// Whether no cell of the rectangle, which includes its last column and row, is marked.
    bool none(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const {
        return no_block(left / side, right / side, top / side, bottom / side) ||
               none_in_blocks(left, right, top, bottom);
    }

  private:
    static constexpr std::size_t side = 8;  ///< of a block

    bool no_block(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const {
        const std::uint32_t *above = &counts_[top * (wide_ + 1)],
                            *below = &counts_[(bottom + 1) * (wide_ + 1)];
        return below[right + 1] - below[left] == above[right + 1] - above[left];
    }
    bool none_in_blocks(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const;
    void count();

    std::size_t wide_ = 0, high_ = 0;    ///< blocks
    std::vector<std::uint64_t> blocks_;  ///< bit 8 * row + column
    /// Blocks with marks, of all above and to the left, so that four of these count any rectangle.
    std::vector<std::uint32_t> counts_;
};

template <class Marks>
MarkedCells::MarkedCells(std::size_t columns, std::size_t rows, Marks marks)
    : wide_((columns + side - 1) / side), high_((rows + side - 1) / side), blocks_(wide_ * high_) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; column += side)
            blocks_[row / side * wide_ + column / side] |=
                std::uint64_t{marks(column, row, columns - column < side ? columns - column : side)}
                << row % side * side;
    count();
}

}  // namespace forage::bug
