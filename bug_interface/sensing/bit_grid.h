// A grid of bits that quickly tells whether a rectangle contains a set bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace forage::bug {

/// A grid with one bit per cell. The bits are stored in blocks of 8 x 8 cells, with a summed-area table of
/// the blocks with set bits. A grid of 2000 x 2000 cells takes 0.75 MB and stays in the cache.
class BitGrid {
  public:
    BitGrid() = default;
    /// `bits_of(column, row, count)` returns the bits of up to 8 cells of a row, from `column` on; the lowest
    /// bit is that of the first cell.
    template <class BitsOf>
    BitGrid(std::size_t columns, std::size_t rows, BitsOf bits_of);

    /// Whether no bit is set in the rectangle, which includes the column `right` and the row `bottom`.
    bool none_in(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const {
        return no_block_in(left / side, right / side, top / side, bottom / side) ||
               none_in_blocks(left, right, top, bottom);
    }

  private:
    static constexpr std::size_t side = 8;  ///< side of a block, cells

    bool no_block_in(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const {
        const std::uint32_t *above = &sums_[top * (blocks_wide_ + 1)],
                            *below = &sums_[(bottom + 1) * (blocks_wide_ + 1)];
        return below[right + 1] - below[left] == above[right + 1] - above[left];
    }
    bool none_in_blocks(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const;
    void make_sums();

    std::size_t blocks_wide_ = 0, blocks_high_ = 0;
    std::vector<std::uint64_t> blocks_;  ///< cell (row, column) of a block is bit 8 * row + column
    /// Summed-area table: the number of blocks with set bits above and to the left of each block.
    std::vector<std::uint32_t> sums_;
};

template <class BitsOf>
BitGrid::BitGrid(std::size_t columns, std::size_t rows, BitsOf bits_of)
    : blocks_wide_((columns + side - 1) / side),
      blocks_high_((rows + side - 1) / side),
      blocks_(blocks_wide_ * blocks_high_) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; column += side)
            blocks_[row / side * blocks_wide_ + column / side] |=
                std::uint64_t{bits_of(column, row, columns - column < side ? columns - column : side)}
                << row % side * side;
    make_sums();
}

}  // namespace forage::bug
