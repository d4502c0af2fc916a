#include "core/base/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/digest.h"
#include "core/base/philox.h"
#include "core/base/simd.h"

namespace forage {
namespace {

std::uint64_t mix(std::uint64_t x) {  // finalizer of splitmix64
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

using philox::Draw;

/// Computes the words 2 i and 2 i + 1 for `count` pairs i from `first` on.
FORAGE_SIMD void pairs_of_words(const Draw& d, std::uint32_t first, std::size_t count, std::uint64_t* out) {
    const Draw own = d;  // what is stored into `out` cannot change it
    for (std::size_t i = 0; i < count; ++i) {
        const auto block = philox::block(own, first + static_cast<std::uint32_t>(i), 0);
        out[2 * i] = std::uint64_t{block[0]} << 32 | block[1];
        out[2 * i + 1] = std::uint64_t{block[2]} << 32 | block[3];
    }
}

/// Computes RandomStream::bits() for any draw, beginning with number `first`, which must be even.
void words(const Draw& d, std::span<std::uint64_t> out, std::size_t first) {
    const auto pair = static_cast<std::uint32_t>(first / 2);
    const std::size_t pairs = out.size() / 2;
    pairs_of_words(d, pair, pairs, out.data());
    if (out.size() % 2 == 0) return;
    std::uint64_t last[2];
    pairs_of_words(d, pair + static_cast<std::uint32_t>(pairs), 1, last);
    out.back() = last[0];
}

double to_unit(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view item, std::uint32_t stream)
    : key_(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ fnv1a(item)) + mix(stream + 0x9e3779b97f4a7c15u)) {}

double RandomStream::uniform(std::uint64_t cycle, std::uint32_t index, std::uint32_t draw) const {
    const auto block = philox::block(philox::draw_of(key_, cycle, draw), index / 2, 0);
    const std::uint32_t odd = index % 2;
    return to_unit(std::uint64_t{block[2 * odd]} << 32 | block[2 * odd + 1]);
}

void RandomStream::bits(std::uint64_t cycle, std::span<std::uint64_t> out) const {
    words(philox::draw_of(key_, cycle, 0), out, 0);
}

void RandomStream::uniform(std::uint64_t cycle, std::span<double> out, std::uint32_t draw,
                           std::size_t first) const {
    const Draw d = philox::draw_of(key_, cycle, draw);
    std::array<std::uint64_t, 256> drawn;
    for (std::size_t i = 0; i < out.size(); i += drawn.size()) {
        const std::size_t count = std::min(drawn.size(), out.size() - i);
        words(d, {drawn.data(), count}, first + i);
        for (std::size_t k = 0; k < count; ++k) out[i + k] = to_unit(drawn[k]);
    }
}

void RandomStream::normal(std::uint64_t cycle, std::span<double> out) const {
    const Draw d = philox::draw_of(key_, cycle, 0);
    std::array<std::uint64_t, 64> drawn;
    for (std::size_t first = 0; first < out.size(); first += drawn.size()) {
        const std::size_t count = std::min(drawn.size(), out.size() - first);
        words(d, {drawn.data(), count + count % 2}, first);
        for (std::size_t i = 0; i < count; i += 2) {
            const double radius = std::sqrt(-2 * std::log(1 - to_unit(drawn[i])));  // 1 - u is in (0, 1]
            const double angle = 2 * std::numbers::pi * to_unit(drawn[i + 1]);
            out[first + i] = radius * std::cos(angle);
            if (i + 1 < count) out[first + i + 1] = radius * std::sin(angle);
        }
    }
}

}  // namespace forage
