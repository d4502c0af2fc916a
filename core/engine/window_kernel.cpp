#include "core/engine/window_kernel.h"

#include <algorithm>
#include <cstring>

#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr Index lanes = 8;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this

/// to[y * width + x] += the sum over the taps, from 0 and in order, for `rows` rows and `blocks` * 8 columns
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

/// All columns of `rows` rows.
template <int rows>
[[gnu::always_inline]] inline void add_rows(const WindowKernel::Tap* taps, std::size_t count, Index at,
                                            Index stride, Index width, double* to) {
    for (Index x = 0; x < width;) {
        const Index left = width - x;
        if (rows == 1 && left > 3 * lanes)
            add_taps<4, rows>(taps, count, at + x, stride, left, width, to + x), x += 4 * lanes;
        else if (left > lanes)
            add_taps<2, rows>(taps, count, at + x, stride, left, width, to + x), x += 2 * lanes;
        else
            add_taps<1, rows>(taps, count, at + x, stride, left, width, to + x), x += lanes;
    }
}

FORAGE_SIMD void add_windows(const WindowKernel::Tap* taps, std::size_t count, Index width, Index first_row,
                             Index last_row, Index stride, double* target) {
    Index y = first_row;
    if (width <= 2 * lanes) {
        for (; y + 4 <= last_row; y += 4)
            add_rows<4>(taps, count, y * stride, stride, width, target + y * width);
        for (; y + 2 <= last_row; y += 2)
            add_rows<2>(taps, count, y * stride, stride, width, target + y * width);
    }
    for (; y < last_row; ++y) add_rows<1>(taps, count, y * stride, stride, width, target + y * width);
}

FORAGE_SIMD void scale(const double* from, double gain, Index n, double* to) {
    for (Index i = 0; i < n; ++i) to[i] = from[i] * gain;
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
    // Four blocks are read at a time, past the last cell of a row.
    const auto cells = static_cast<std::size_t>(stride_ * (top_ + height_ + bottom) + 4 * lanes);
    framed_.assign(delays_.size(), std::vector<double>(cells));
    for (const auto& tap : r.taps) {
        const auto d =
            static_cast<std::size_t>(std::find(delays_.begin(), delays_.end(), tap.delay) - delays_.begin());
        taps_.push_back(
            {framed_[d].data() + (top_ + tap.dy) * stride_ + left_ + tap.dx, r.reference - tap.attenuation});
    }
}

void WindowKernel::deliver(const History& source, double* target) {
    prepare(source, 0, 1);
    add(source, target, 0, 1);
}

void WindowKernel::prepare(const History& source, int part, int parts) {
    const double gain = synapse_.gain();
    const Range rows(static_cast<std::size_t>(height_), part, parts);
    for (std::size_t d = 0; d < delays_.size(); ++d) {
        const double* from = source.ago(delays_[d]);
        double* to = framed_[d].data() + top_ * stride_ + left_;
        for (auto y = static_cast<Index>(rows.first); y < static_cast<Index>(rows.last); ++y)
            scale(from + y * width_, gain, width_, to + y * stride_);
    }
}

void WindowKernel::add(const History&, double* target, int part, int parts) {
    const Range rows(static_cast<std::size_t>(height_), part, parts);
    add_windows(taps_.data(), taps_.size(), width_, static_cast<Index>(rows.first),
                static_cast<Index>(rows.last), stride_, target);
}

}  // namespace forage::engine
