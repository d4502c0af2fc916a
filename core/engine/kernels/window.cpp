// A window of synapses round every cell, the same everywhere: only the window's own weights are moved.
// For layers of retinas and maps, 10^4 cells and more: 11 x 11 synapses per cell cost 0.07 ns each, a
// tenth of a list.
#include <cstring>

#include "core/base/simd.h"
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

constexpr Index lanes = 4;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this

/// Synapses of the window below each other, which follow each other in synapse order.
struct TapColumn {
    Index source;           ///< place in the frames of what target cell 0 reads through the first one
    const double* factors;  ///< from the top down
    Index taps;
};

/// A tile of target cells, whose sums stay in registers. What is read of the source serves several rows of
/// them. `scaled`: the factors are in the source already.
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
            for (int b = 0; b < blocks; ++b) sums[y][b] += scaled ? values[b] : values[b] * f;
        }
    }
    /// Source rows that only some target rows read: the first `rows` - 1 and the last.
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
    /// One tap for all target rows.
    template <int y>
    [[gnu::always_inline]] void add_tap(const double* from, const double* factor, Index stride) {
        if constexpr (y < rows) {
            add_row<y, y + 1>(from, factor + y);
            add_tap<y + 1>(from + stride, factor, stride);
        }
    }
    [[gnu::always_inline]] void add(const double* frames, const TapColumn& c, Index at, Index stride) {
        const double* from = frames + c.source + at;
        if (c.taps < rows - 1) {
            for (Index r = 0; r < c.taps; ++r, from += stride) add_tap<0>(from, c.factors + r, stride);
            return;
        }
        from = enter<rows - 1>(from, c.factors, stride);
        for (Index r = rows - 1; r < c.taps; ++r, from += stride) add_row<0, rows>(from, c.factors + r);
        leave<1>(from, c.factors + c.taps - 1, stride);
    }
};

/// The window's source and target.
struct Field {
    const double* frames;
    const TapColumn* columns;
    std::size_t count;
    Index width, stride;  ///< of the target's rows, and from one row of the source to the next
};

/// Of the cells from source cell `at` on, the first `left` exist.
template <int rows, int blocks, bool scaled>
[[gnu::always_inline]] inline void add_tile(const Field& f, Index at, Index left, double* to) {
    Tile<rows, blocks, scaled> tile;
    for (auto& row : tile.sums)
        for (Lanes& sum : row) sum = Lanes{};
    for (std::size_t i = 0; i < f.count; ++i) tile.add(f.frames, f.columns[i], at, f.stride);
#pragma GCC unroll 8
    for (int y = 0; y < rows; ++y, to += f.width)
#pragma GCC unroll 8
        for (int b = 0; b < blocks; ++b)
            if (b < blocks - 1 || left >= blocks * lanes) {
                Lanes cells;
                std::memcpy(&cells, to + b * lanes, sizeof cells);
                cells += tile.sums[y][b];
                std::memcpy(to + b * lanes, &cells, sizeof cells);
            } else {
                double last[lanes];
                std::memcpy(last, &tile.sums[y][b], sizeof last);
                for (Index x = b * lanes; x < left; ++x) to[x] += last[x - b * lanes];
            }
}

template <int rows, bool scaled>
[[gnu::always_inline]] inline void add_rows(const Field& f, Index y, double* target) {
    for (Index x = 0, blocks; x < f.width; x += blocks * lanes) {
        const Index at = y * f.stride + x, left = f.width - x;
        double* to = target + y * f.width + x;
        blocks = left > 2 * lanes ? 3 : left > lanes ? 2 : 1;
        if (blocks == 3)
            add_tile<rows, 3, scaled>(f, at, left, to);
        else if (blocks == 2)
            add_tile<rows, 2, scaled>(f, at, left, to);
        else
            add_tile<rows, 1, scaled>(f, at, left, to);
    }
}

template <bool scaled>
[[gnu::always_inline]] inline void add_all(const Field& f, Index y, Index last, double* target) {
    for (; y + 4 <= last; y += 4) add_rows<4, scaled>(f, y, target);
    for (; y + 2 <= last; y += 2) add_rows<2, scaled>(f, y, target);
    for (; y < last; ++y) add_rows<1, scaled>(f, y, target);
}

FORAGE_SIMD void add_scaled_window(const Field& f, Index first_row, Index last_row, double* target) {
    add_all<true>(f, first_row, last_row, target);
}
FORAGE_SIMD void add_weighted_window(const Field& f, Index first_row, Index last_row, double* target) {
    add_all<false>(f, first_row, last_row, target);
}

/// Rows of `width` numbers, `stride` apart in `to`.
FORAGE_SIMD void scale_rows(const double* from, double gain, double factor, Index width, Index rows,
                            Index stride, double* to) {
    for (Index y = 0; y < rows; ++y, from += width, to += stride)
        for (Index x = 0; x < width; ++x) to[x] = from[x] * gain * factor;
}

class Window final : public SharedKernel {
  public:
    explicit Window(const connectivity::Regular& r) : width_(r.width), height_(r.height) {
        Index right = 0, bottom = 0;
        for (const auto& tap : r.taps) {
            left_ = std::max<Index>(left_, -tap.dx), right = std::max<Index>(right, tap.dx);
            top_ = std::max<Index>(top_, -tap.dy), bottom = std::max<Index>(bottom, tap.dy);
            if (std::find(delays_.begin(), delays_.end(), tap.delay) == delays_.end())
                delays_.push_back(tap.delay);
            factors_.push_back(r.reference - tap.attenuation);
        }
        same_factor_ =
            std::all_of(factors_.begin(), factors_.end(), [&](double f) { return f == factors_.front(); });
        stride_ = left_ + width_ + right;
        const Index read_beyond = 3 * lanes;  // past the last cell of a row
        frame_ = stride_ * (top_ + height_ + bottom) + read_beyond;
        for (std::size_t i = 0; i < r.taps.size(); ++i) {
            const auto& tap = r.taps[i];
            const auto d = std::find(delays_.begin(), delays_.end(), tap.delay) - delays_.begin();
            const Index source = d * frame_ + (top_ + tap.dy) * stride_ + left_ + tap.dx;
            if (i > 0 && source == columns_.back().source + columns_.back().taps * stride_)
                ++columns_.back().taps;
            else
                columns_.push_back({source, &factors_[i], 1});
        }
    }
    std::unique_ptr<Workspace> make_workspace() const override {
        auto out = std::make_unique<Frames>();
        out->numbers.resize(static_cast<std::size_t>(frame_) * delays_.size());
        return out;
    }
    void prepare(const KernelInput& in, Part part) const override {
        const auto first = static_cast<Index>(part.first(height_)),
                   count = static_cast<Index>(part.last(height_)) - first;
        double* to = static_cast<Frames*>(in.workspace)->numbers.data() + (top_ + first) * stride_ + left_;
        for (const int delay : delays_) {
            scale_rows(in.ago(delay) + first * width_, in.synapse.gain(), same_factor_ ? factors_.front() : 1,
                       width_, count, stride_, to);
            to += frame_;
        }
    }
    void add(const Workspace& frames, double* target, Part part) const override {
        // Pairs of rows: a single one costs more than half a pair.
        const std::size_t pairs = (height_ + 1) / 2;
        const auto first = static_cast<Index>(2 * part.first(pairs)),
                   last = std::min(static_cast<Index>(2 * part.last(pairs)), height_);
        const double* numbers = static_cast<const Frames&>(frames).numbers.data();
        (same_factor_ ? add_scaled_window : add_weighted_window)(
            {numbers, columns_.data(), columns_.size(), width_, stride_}, first, last, target);
    }
    Index target_cells() const override { return width_ * height_; }
    std::string_view form() const override { return "window"; }
    double cost() const override {
        return 0.07 * static_cast<double>(factors_.size()) * static_cast<double>(target_cells());
    }

  private:
    /// The source's activity times the gain in a frame of zeros, once per delay: a window may reach
    /// out of the group, and what it reads there adds nothing.
    struct Frames final : Workspace {
        std::vector<double> numbers;
    };

    Index width_, height_, left_ = 0, top_ = 0, stride_ = 0;
    Index frame_ = 0;              ///< numbers in a frame
    std::vector<int> delays_;      ///< those that occur
    std::vector<double> factors_;  ///< of the taps
    std::vector<TapColumn> columns_;
    bool same_factor_ = false;  ///< the frames hold the products with it
};

}  // namespace

std::unique_ptr<Kernel> make_window(const connectivity::Regular& window) {
    return std::make_unique<Window>(window);
}

}  // namespace forage::engine
