#include "bug_interface/sensing/bit_grid.h"

#include <vector>

#include "core/base/random.h"
#include "tests/support/catch.h"

using namespace forage;
using namespace forage::bug;

TEST_CASE("Set bits are found in every rectangle that contains them and in no other") {
    const RandomStream random(1, "cells");
    std::uint64_t draw = 0;
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(random.uniform(draw++, 0) * static_cast<double>(n));
    };
    for (int grid = 0; grid < 200; ++grid) {
        const std::size_t columns = 1 + below(40), rows = 1 + below(40);
        const double share = random.uniform(draw++, 0) * 0.05;
        std::vector<char> marked(columns * rows);
        for (char& m : marked) m = random.uniform(draw++, 0) < share;
        const BitGrid cells(columns, rows, [&](std::size_t column, std::size_t row, std::size_t count) {
            unsigned bits = 0;
            for (std::size_t i = 0; i < count; ++i) bits |= marked[row * columns + column + i] ? 1u << i : 0u;
            return bits;
        });
        for (int rectangle = 0; rectangle < 500; ++rectangle) {
            const std::size_t left = below(columns), right = left + below(columns - left), top = below(rows),
                              bottom = top + below(rows - top);
            bool none = true;
            for (std::size_t row = top; row <= bottom; ++row)
                for (std::size_t column = left; column <= right; ++column)
                    none &= !marked[row * columns + column];
            INFO(columns << " x " << rows << ": " << left << ".." << right << ", " << top << ".." << bottom);
            REQUIRE(cells.none_in(left, right, top, bottom) == none);
        }
    }
}
