#include "core/engine/kernels/window_columns.h"

#include <algorithm>
#include <cstring>

#include "core/base/simd.h"

namespace forage::engine {
namespace {

constexpr Index lanes = 4;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this

/// A tile of target cells, whose sums stay in registers.
template <int rows, int blocks, bool scaled>
struct Tile {
    Lanes sums[rows][blocks];

    /// The source row `from` is tap `factor - y` of target row y, for rows first to last - 1.
    template <int first, int last>
    [[gnu::always_inline]] void add_row(const double* from, const double* factor) {
        Lanes values[blocks];
#pragma GCC unroll 8
        for (int b = 0; b < blocks; ++b) std::memcpy(&values[b], from + b * lanes, sizeof(Lanes));
#pragma GCC unroll 8
        for (int y = first; y < last; ++y) {
            const double f = scaled ? 1 : factor[-y];
#pragma GCC unroll 8
            for (int b = 0; b < blocks; ++b)
                if constexpr (scaled)
                    sums[y][b] += values[b];
                else
                    sums[y][b] += values[b] * f;
        }
    }

    /// Source rows that only some target rows hear: the first `rows` - 1 and the last.
    template <int r>
    [[gnu::always_inline]] const double* enter(const double* from, const double* factors, Index stride) {
        if constexpr (r > 0) from = enter<r - 1>(from, factors, stride);
        if constexpr (r < rows - 1) add_row<0, r + 1>(from, factors + r), from += stride;
        return from;
    }
    template <int r>
    [[gnu::always_inline]] void leave(const double* from, const double* factors, Index stride) {
        if constexpr (r < rows) {
            add_row<r, rows>(from, factors + r);
            leave<r + 1>(from + stride, factors, stride);
        }
    }

    [[gnu::always_inline]] void add(const TapColumn& c, Index at, Index stride) {
        const double* from = enter<rows - 1>(c.source + at, c.factors, stride);
        for (Index r = rows - 1; r < c.taps; ++r, from += stride) add_row<0, rows>(from, c.factors + r);
        leave<1>(from, c.factors + c.taps - 1, stride);
    }
};

/// Of the columns from source cell `at` on, the first `left` exist.
template <int rows, int blocks, bool scaled>
[[gnu::always_inline]] inline void add_tile(const TapColumn* columns, std::size_t count, Index at,
                                            Index stride, Index left, Index width, double* to) {
    Tile<rows, blocks, scaled> tile;
    for (auto& row : tile.sums)
        for (Lanes& sum : row) sum = Lanes{};
    for (std::size_t i = 0; i < count; ++i) tile.add(columns[i], at, stride);
#pragma GCC unroll 8
    for (int y = 0; y < rows; ++y, to += width) {
#pragma GCC unroll 8
        for (int b = 0; b < blocks - 1; ++b) {
            Lanes cells;
            std::memcpy(&cells, to + b * lanes, sizeof cells);
            cells += tile.sums[y][b];
            std::memcpy(to + b * lanes, &cells, sizeof cells);
        }
        const Index first = (blocks - 1) * lanes;
        if (left >= blocks * lanes) {
            Lanes cells;
            std::memcpy(&cells, to + first, sizeof cells);
            cells += tile.sums[y][blocks - 1];
            std::memcpy(to + first, &cells, sizeof cells);
        } else {
            double last[lanes];
            std::memcpy(last, &tile.sums[y][blocks - 1], sizeof last);
            for (Index x = first; x < left; ++x) to[x] += last[x - first];
        }
    }
}

template <int rows, bool scaled>
[[gnu::always_inline]] inline void add_rows(const TapColumn* columns, std::size_t count, Index at,
                                            Index stride, Index width, double* to) {
    for (Index x = 0; x < width;) {
        const Index left = width - x;
        if (left > 2 * lanes)
            add_tile<rows, 3, scaled>(columns, count, at + x, stride, left, width, to + x), x += 3 * lanes;
        else if (left > lanes)
            add_tile<rows, 2, scaled>(columns, count, at + x, stride, left, width, to + x), x += 2 * lanes;
        else
            add_tile<rows, 1, scaled>(columns, count, at + x, stride, left, width, to + x), x += lanes;
    }
}

template <bool scaled>
[[gnu::always_inline]] inline void add_all(const TapColumn* columns, std::size_t count, Index width,
                                           Index first_row, Index last_row, Index stride, double* target) {
    Index y = first_row;
    static_assert(TapColumn::least >= 4 - 1);
    for (; y + 4 <= last_row; y += 4)
        add_rows<4, scaled>(columns, count, y * stride, stride, width, target + y * width);
    for (; y + 2 <= last_row; y += 2)
        add_rows<2, scaled>(columns, count, y * stride, stride, width, target + y * width);
    for (; y < last_row; ++y)
        add_rows<1, scaled>(columns, count, y * stride, stride, width, target + y * width);
}

FORAGE_SIMD void add_scaled(const TapColumn* columns, std::size_t count, Index width, Index first_row,
                            Index last_row, Index stride, double* target) {
    add_all<true>(columns, count, width, first_row, last_row, stride, target);
}

FORAGE_SIMD void add_weighted(const TapColumn* columns, std::size_t count, Index width, Index first_row,
                              Index last_row, Index stride, double* target) {
    add_all<false>(columns, count, width, first_row, last_row, stride, target);
}

}  // namespace

void add_columns(const TapColumn* columns, std::size_t count, bool scaled, Index width, Index first_row,
                 Index last_row, Index stride, double* target) {
    (scaled ? add_scaled : add_weighted)(columns, count, width, first_row, last_row, stride, target);
}

}  // namespace forage::engine
