// Random events with a given probability, for many cells at a time.
//
// A cell gets 16 random bits, which are compared with the upper 16 of the probability's 53; where these are
// equal, once in 65536 times, the lower 37 decide. Thus 8 cells share one block of Philox, while 8 uniform
// numbers take 4 blocks.
//
// 64 cells are a batch: its 8 blocks are lanes l = 0..7, and half m of word j of block l belongs to cell 8 (2
// j + m) + l. Thus each vector of 8 lanes gives 8 neighbouring cells.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/philox.h"
#include "core/base/random.h"
#include "core/base/simd.h"

namespace forage {
namespace {

using philox::Draw;

constexpr std::size_t lanes = 8, batch = 8 * lanes;
constexpr std::size_t together = 8;  ///< batches
constexpr std::uint32_t events_stream = 0x80000000u,
                        ties_stream = 0xc0000000u;  // different from those of uniform()

/// A cell is silent when its bits are below `top`, or equal to it and the next 37 bits are below `rest`.
struct Threshold {
    std::uint32_t top;
    std::uint64_t rest;

    explicit Threshold(double probability) {
        const double silent = std::ceil((1 - probability) * 0x1p53);  // may be NaN
        const auto bits = static_cast<std::uint64_t>(silent < 0x1p53 ? std::max(silent, 0.0) : 0x1p53);
        top = static_cast<std::uint32_t>(bits >> 37);
        rest = bits & ((std::uint64_t{1} << 37) - 1);
    }
};

bool tie_is_active(const Draw& d, std::size_t cell, const Threshold& t) {
    const auto r = philox::block(d, static_cast<std::uint32_t>(cell), ties_stream);
    return (std::uint64_t{r[0]} << 5 | r[1] >> 27) >= t.rest;
}

/// Computes `count` batches from the `number`-th on, but leaves cells silent whose bits are equal to `top`.
/// Returns whether there is one.
FORAGE_SIMD bool compare_batches(const Draw& d, std::size_t number, std::size_t count, std::uint32_t top,
                                 double value, double* out) {
    const Draw own = d;  // what is stored cannot change it
    const auto first = static_cast<std::uint32_t>(number * lanes),
               blocks = static_cast<std::uint32_t>(count * lanes);
    std::uint32_t words[4][together * lanes];
    for (std::uint32_t i = 0; i < blocks; ++i) {
        const auto block = philox::block(own, first + i, events_stream);
        for (std::size_t j = 0; j < 4; ++j) words[j][i] = block[j];
    }
    std::int32_t bits[together * batch], *to = bits;  // by cell
    for (std::size_t k = 0; k < blocks; k += lanes)
        for (std::size_t j = 0; j < 4; ++j, to += 2 * lanes)
            for (std::size_t l = 0; l < lanes; ++l) {
                to[l] = static_cast<std::int32_t>(words[j][k + l] & 0xffffu);
                to[l + lanes] = static_cast<std::int32_t>(words[j][k + l] >> 16);
            }
    int ties = 0;
    for (std::size_t cell = 0; cell < count * batch; ++cell) {
        ties |= bits[cell] == static_cast<std::int32_t>(top);
        out[cell] = bits[cell] > static_cast<std::int32_t>(top) ? value : 0.0;
    }
    return ties != 0;
}

/// Decides the cells of a batch whose bits are equal to `t.top`.
void break_ties(const Draw& d, std::size_t number, const Threshold& t, double value, double* out) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto words = philox::block(d, static_cast<std::uint32_t>(number * lanes + lane), events_stream);
        for (std::size_t part = 0; part < 8; ++part) {
            const std::size_t cell = part * lanes + lane;
            if ((words[part / 2] >> 16 * (part % 2) & 0xffffu) == t.top &&
                tie_is_active(d, number * batch + cell, t))
                out[cell] = value;
        }
    }
}

/// Computes `count` batches, beginning with the `number`-th.
void batches(const Draw& d, std::size_t number, std::size_t count, const Threshold& t, double value,
             double* out) {
    for (std::size_t n; count > 0; number += n, count -= n, out += n * batch) {
        n = std::min(count, together);
        if (!compare_batches(d, number, n, t.top, value, out)) continue;
        for (std::size_t k = 0; k < n; ++k) break_ties(d, number + k, t, value, out + k * batch);
    }
}

}  // namespace

void RandomStream::events(std::uint64_t cycle, double probability, std::span<double> out, double value,
                          std::uint32_t draw, std::size_t first) const {
    static_assert(grain == batch);
    const Draw d = philox::draw_of(key_, cycle, draw);
    const Threshold threshold(probability);
    const std::size_t whole = out.size() / batch, before = first / batch;
    batches(d, before, whole, threshold, value, out.data());
    if (const std::size_t left = out.size() % batch) {
        std::array<double, batch> last;
        batches(d, before + whole, 1, threshold, value, last.data());
        std::copy_n(last.begin(), left, out.end() - static_cast<std::ptrdiff_t>(left));
    }
}

}  // namespace forage
