#include "core/types/random.h"

#include <cmath>
#include <numbers>

#include "core/types/philox.h"

namespace forage {
namespace {

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
    const auto r = philox::block(philox::draw_of(key, cycle, draw), pair, 0);
    return {std::uint64_t{r[0]} << 32 | r[1], std::uint64_t{r[2]} << 32 | r[3]};
}

#ifdef FORAGE_AVX2
/// As many of the first words as come in sixteens; returns how many.
FORAGE_AVX2 std::size_t words_by_lanes(const philox::Draw& d, std::uint64_t* out, std::size_t count) {
    std::size_t i = 0;
    for (; i + 2 * philox::lanes <= count; i += 2 * philox::lanes) {
        __m256i w[4];
        philox::blocks(d, static_cast<std::uint32_t>(i / 2), 0, w);
        // a: the first word of a block, b: the second; of blocks 0 1 4 5, then of 2 3 6 7.
        const __m256i a[2] = {_mm256_unpacklo_epi32(w[1], w[0]), _mm256_unpackhi_epi32(w[1], w[0])};
        const __m256i b[2] = {_mm256_unpacklo_epi32(w[3], w[2]), _mm256_unpackhi_epi32(w[3], w[2])};
        for (int half = 0; half < 2; ++half) {
            const __m256i even = _mm256_unpacklo_epi64(a[half], b[half]);
            const __m256i odd = _mm256_unpackhi_epi64(a[half], b[half]);
            std::uint64_t* to = out + i + 4 * static_cast<std::size_t>(half);
            const auto store = [](std::uint64_t* at, __m128i v) {
                _mm_storeu_si128(reinterpret_cast<__m128i*>(at), v);
            };
            store(to, _mm256_castsi256_si128(even));
            store(to + 2, _mm256_castsi256_si128(odd));
            store(to + 8, _mm256_extracti128_si256(even, 1));
            store(to + 10, _mm256_extracti128_si256(odd, 1));
        }
    }
    return i;
}
#endif

double to_unit(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view item, std::uint32_t stream)
    : key_(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ fnv1a(item)) + mix(stream + 0x9e3779b97f4a7c15u)) {}

double RandomStream::uniform(std::uint64_t cycle, std::uint32_t index, std::uint32_t draw) const {
    const auto [a, b] = words(key_, cycle, index / 2, draw);
    return to_unit(index % 2 ? b : a);
}

void RandomStream::bits(std::uint64_t cycle, std::span<std::uint64_t> out) const {
    std::size_t i = 0;
#ifdef FORAGE_AVX2
    if (philox::eight_at_a_time())
        i = words_by_lanes(philox::draw_of(key_, cycle, 0), out.data(), out.size());
#endif
    for (; i < out.size(); i += 2) {
        const auto [a, b] = words(key_, cycle, static_cast<std::uint32_t>(i / 2));
        out[i] = a;
        if (i + 1 < out.size()) out[i + 1] = b;
    }
}

void RandomStream::uniform(std::uint64_t cycle, std::span<double> out, std::uint32_t draw,
                           std::size_t first) const {
    for (std::size_t i = 0; i < out.size(); i += 2) {
        const auto [a, b] = words(key_, cycle, static_cast<std::uint32_t>((first + i) / 2), draw);
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
