#include "core/types/random.h"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

namespace forage {
namespace {

using Philox = r123::Philox4x32;

std::uint64_t mix(std::uint64_t x) {  // finalizer of splitmix64
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

std::uint64_t fnv1a(std::string_view text) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (unsigned char c : text) h = (h ^ c) * 0x100000001b3u;
    return h;
}

/// Two 64-bit words: numbers 2*pair and 2*pair+1 of this cycle.
std::pair<std::uint64_t, std::uint64_t> words(std::uint64_t key, std::uint64_t cycle, std::uint32_t pair,
                                              std::uint32_t draw = 0) {
    const Philox::ctr_type counter{
        {pair, static_cast<std::uint32_t>(cycle), static_cast<std::uint32_t>(cycle >> 32), draw}};
    const Philox::key_type k{{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
    const auto r = Philox{}(counter, k);
    return {std::uint64_t{r[0]} << 32 | r[1], std::uint64_t{r[2]} << 32 | r[3]};
}

double to_unit(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view item, std::uint32_t stream)
    : key_(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ fnv1a(item)) + mix(stream + 0x9e3779b97f4a7c15u)) {}

double RandomStream::uniform(std::uint64_t cycle, std::uint32_t index, std::uint32_t draw) const {
    const auto [a, b] = words(key_, cycle, index / 2, draw);
    return to_unit(index % 2 ? b : a);
}

void RandomStream::bits(std::uint64_t cycle, std::span<std::uint64_t> out) const {
    for (std::size_t i = 0; i < out.size(); i += 2) {
        const auto [a, b] = words(key_, cycle, static_cast<std::uint32_t>(i / 2));
        out[i] = a;
        if (i + 1 < out.size()) out[i + 1] = b;
    }
}

void RandomStream::uniform(std::uint64_t cycle, std::span<double> out, std::uint32_t draw) const {
    for (std::size_t i = 0; i < out.size(); i += 2) {
        const auto [a, b] = words(key_, cycle, static_cast<std::uint32_t>(i / 2), draw);
        out[i] = to_unit(a);
        if (i + 1 < out.size()) out[i + 1] = to_unit(b);
    }
}

void RandomStream::normal(std::uint64_t cycle, std::span<double> out) const {
    for (std::size_t i = 0; i < out.size(); i += 2) {
        const auto [a, b] = words(key_, cycle, static_cast<std::uint32_t>(i / 2));
        const double radius = std::sqrt(-2 * std::log(1 - to_unit(a)));  // 1 - u is in (0, 1]
        const double angle = 2 * std::numbers::pi * to_unit(b);
        out[i] = radius * std::cos(angle);
        if (i + 1 < out.size()) out[i + 1] = radius * std::sin(angle);
    }
}

}  // namespace forage
