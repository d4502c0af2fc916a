#include "core/engine/kernels/window_kernel.h"

#include <algorithm>
#include <cstring>

#include "core/base/simd.h"

namespace forage::engine {
namespace {

constexpr Index lanes = 4;  // GCC takes wider vectors apart where the processor has no AVX-512
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this

/// to[y * width + x] += the sum over the taps, from 0 and in order, for `rows` rows and `blocks` * 4 columns
/// from source cell `at` on, of which the first `columns` exist. Additions wait for each other, so several
/// sums are made side by side.
template <int blocks, int rows>
[[gnu::always_inline]] inline void add_taps(const WindowKernel::Tap* taps, std::size_t count, Index at,
                                            Index stride, Index columns, Index width, double* to) {
    Lanes sums[rows][blocks];
    for (auto& row : sums)  // one by one, so that they stay in registers
        for (Lanes& sum : row) sum = Lanes{};
    for (std::size_t k = 0; k < count; ++k) {
        const double* from = taps[k].source + at;
        const double factor = taps[k].factor;
        for (int y = 0; y < rows; ++y)
            for (int b = 0; b < blocks; ++b) {
                Lanes values;
                std::memcpy(&values, from + y * stride + b * lanes, sizeof values);
                sums[y][b] += values * factor;
            }
    }
    for (int y = 0; y < rows; ++y) {
        double row[blocks * lanes];
        std::memcpy(row, sums[y], sizeof row);
        for (Index i = 0; i < std::min(columns, blocks * lanes); ++i) to[y * width + i] += row[i];
    }
}

/// All columns of `rows` rows; at most eight sums side by side, as AVX2 has sixteen registers.
template <int rows>
[[gnu::always_inline]] inline void add_rows(const WindowKernel::Tap* taps, std::size_t count, Index at,
                                            Index stride, Index width, double* to) {
    for (Index x = 0; x < width;) {
        const Index left = width - x;
        if (rows == 1 && left > 4 * lanes)
            add_taps<8, 1>(taps, count, at + x, stride, left, width, to + x), x += 8 * lanes;
        else if (rows <= 2 && left > 2 * lanes)
            add_taps<4, std::min(rows, 2)>(taps, count, at + x, stride, left, width, to + x), x += 4 * lanes;
        else if (left > lanes)
            add_taps<2, rows>(taps, count, at + x, stride, left, width, to + x), x += 2 * lanes;
        else
            add_taps<1, rows>(taps, count, at + x, stride, left, width, to + x), x += lanes;
    }
}

FORAGE_SIMD void add_windows(const WindowKernel::Tap* taps, std::size_t count, Index width, Index first_row,
                             Index last_row, Index stride, double* target) {
    Index y = first_row;
    if (width <= 2 * lanes)
        for (; y + 4 <= last_row; y += 4)
            add_rows<4>(taps, count, y * stride, stride, width, target + y * width);
    if (width <= 4 * lanes)
        for (; y + 2 <= last_row; y += 2)
            add_rows<2>(taps, count, y * stride, stride, width, target + y * width);
    for (; y < last_row; ++y) add_rows<1>(taps, count, y * stride, stride, width, target + y * width);
}

/// Rows of `width` numbers, `stride` apart. The second factor is 1 for windows whose taps have their own.
FORAGE_SIMD void scale(const double* from, double gain, double factor, Index width, Index rows, Index stride,
                       double* to) {
    constexpr Index step = 4;
    for (Index y = 0; y < rows; ++y, from += width, to += stride) {
        Index x = 0;
        for (; x + step <= width; x += step)
            for (Index i = x; i < x + step; ++i) to[i] = from[i] * gain * factor;
        for (; x < width; ++x) to[x] = from[x] * gain * factor;
    }
}

}  // namespace

WindowKernel::WindowKernel(const connectivity::Regular& r, const SynapseInstance& synapse)
    : synapse_(synapse), width_(r.width), height_(r.height), left_(0), top_(0) {
    Index right = 0, bottom = 0;
    for (const auto& tap : r.taps) {
        left_ = std::max<Index>(left_, -tap.dx), right = std::max<Index>(right, tap.dx);
        top_ = std::max<Index>(top_, -tap.dy), bottom = std::max<Index>(bottom, tap.dy);
        if (std::find(delays_.begin(), delays_.end(), tap.delay) == delays_.end())
            delays_.push_back(tap.delay);
    }
    stride_ = left_ + width_ + right;
    // Eight blocks are read at a time, past the last cell of a row.
    const auto cells = static_cast<std::size_t>(stride_ * (top_ + height_ + bottom) + 8 * lanes);
    framed_.assign(delays_.size(), std::vector<double>(cells));
    for (const auto& tap : r.taps) {
        const auto d =
            static_cast<std::size_t>(std::find(delays_.begin(), delays_.end(), tap.delay) - delays_.begin());
        taps_.push_back(
            {framed_[d].data() + (top_ + tap.dy) * stride_ + left_ + tap.dx, r.reference - tap.attenuation});
        factors_.push_back(taps_.back().factor);
    }
    find_columns();
}

void WindowKernel::find_columns() {
    for (std::size_t i = 0; i < taps_.size(); ++i)
        if (i > 0 && taps_[i].source == taps_[i - 1].source + stride_)
            ++columns_.back().taps;
        else
            columns_.push_back({taps_[i].source, &factors_[i], 1});
    if (std::any_of(columns_.begin(), columns_.end(), [](auto& c) { return c.taps < TapColumn::least; }))
        return columns_.clear();
    same_factor_ =
        std::all_of(factors_.begin(), factors_.end(), [&](double f) { return f == factors_.front(); });
}

void WindowKernel::deliver(const History& source, double* target) {
    prepare(source, 0, 1);
    add(source, target, 0, 1);
}

void WindowKernel::prepare(const History& source, int part, int parts) {
    const double gain = synapse_.gain(), factor = same_factor_ ? factors_.front() : 1;
    const Range rows(static_cast<std::size_t>(height_), part, parts);
    const auto first = static_cast<Index>(rows.first), count = static_cast<Index>(rows.last) - first;
    for (std::size_t d = 0; d < delays_.size(); ++d)
        scale(source.ago(delays_[d]) + first * width_, gain, factor, width_, count, stride_,
              framed_[d].data() + (top_ + first) * stride_ + left_);
}

void WindowKernel::add(const History&, double* target, int part, int parts) {
    // Pairs of rows: a single one costs more than half a pair.
    const Range pairs(static_cast<std::size_t>(height_ + 1) / 2, part, parts);
    const auto first = static_cast<Index>(2 * pairs.first),
               last = std::min(static_cast<Index>(2 * pairs.last), height_);
    if (columns_.empty())
        add_windows(taps_.data(), taps_.size(), width_, first, last, stride_, target);
    else
        add_columns(columns_.data(), columns_.size(), same_factor_, width_, first, last, stride_, target);
}

}  // namespace forage::engine
