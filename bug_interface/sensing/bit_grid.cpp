#include "bug_interface/sensing/bit_grid.h"

namespace forage::bug {

void BitGrid::make_sums() {
    sums_.assign((blocks_high_ + 1) * (blocks_wide_ + 1), 0);
    for (std::size_t row = 0; row < blocks_high_; ++row) {
        std::uint32_t in_row = 0;
        for (std::size_t column = 0; column < blocks_wide_; ++column) {
            in_row += blocks_[row * blocks_wide_ + column] ? 1 : 0;
            sums_[(row + 1) * (blocks_wide_ + 1) + column + 1] =
                sums_[row * (blocks_wide_ + 1) + column + 1] + in_row;
        }
    }
}

/// Blocks that are entirely in the rectangle are tested as a whole.
bool BitGrid::none_in_blocks(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const {
    const std::size_t first = left / side, last = right / side, inner = (left + side - 1) / side,
                      inner_end = (right + 1) / side;
    const auto bits = [](std::size_t from, std::size_t to) { return (2u << to) - (1u << from); };
    for (std::size_t row = top / side; row <= bottom / side; ++row) {
        const std::size_t low = row * side < top ? top % side : 0,
                          high = (row + 1) * side > bottom + 1 ? bottom % side : side - 1;
        if (no_block_in(first, last, row, row)) continue;
        const bool whole = low == 0 && high == side - 1;
        if (whole && inner < inner_end && !no_block_in(inner, inner_end - 1, row, row)) return false;
        for (std::size_t column = first; column <= last; ++column) {
            const std::uint64_t block = blocks_[row * blocks_wide_ + column];
            if (!block) continue;
            const std::size_t from = column == first ? left % side : 0,
                              to = column == last ? right % side : side - 1;
            const std::uint64_t columns = bits(from, to) * 0x0101010101010101u;  // in every row
            const std::uint64_t rows =
                ~std::uint64_t{0} << low * side & ~std::uint64_t{0} >> (side - 1 - high) * side;
            if (block & columns & rows) return false;
        }
    }
    return true;
}

}  // namespace forage::bug
