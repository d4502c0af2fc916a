#include "core/base/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/philox.h"

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

using philox::Draw;

/// Two 64-bit words, with the numbers 2*pair and 2*pair+1.
std::pair<std::uint64_t, std::uint64_t> words(const Draw& d, std::uint32_t pair) {
    const auto r = philox::block(d, pair, 0);
    return {std::uint64_t{r[0]} << 32 | r[1], std::uint64_t{r[2]} << 32 | r[3]};
}

#ifdef FORAGE_AVX2
/// Computes words from pair `first` on, in multiples of sixteen. Returns their number.
FORAGE_AVX2 std::size_t words_by_lanes(const Draw& d, std::uint32_t first, std::uint64_t* out,
                                       std::size_t count) {
    const philox::Rounds rounds(d, 0);
    constexpr int many = 2;
    std::size_t i = 0;
    for (; i + 2 * philox::lanes <= count; i += 2 * philox::lanes) {
        __m256i words[many][4];
        philox::blocks(rounds, first + static_cast<std::uint32_t>(i / 2), words);
        for (int half = 0; half < many; ++half) {
            const auto& w = words[half];
            const __m256i a =
                _mm256_blend_epi32(w[1], _mm256_slli_epi64(w[0], 32), 0xaa);  // words of 4 blocks
            const __m256i b = _mm256_blend_epi32(w[3], _mm256_slli_epi64(w[2], 32), 0xaa);
            const __m256i even = _mm256_unpacklo_epi64(a, b), odd = _mm256_unpackhi_epi64(a, b);
            auto* const to = reinterpret_cast<__m256i*>(out + i + 8 * static_cast<std::size_t>(half));
            _mm256_storeu_si256(to, _mm256_permute2x128_si256(even, odd, 0x20));
            _mm256_storeu_si256(to + 1, _mm256_permute2x128_si256(even, odd, 0x31));
        }
    }
    return i;
}

/// Computes the same words with AVX-512.
FORAGE_AVX512 std::size_t words_by_wide_lanes(const Draw& d, std::uint32_t first, std::uint64_t* out,
                                              std::size_t count) {
    const __m512i low = _mm512_set1_epi64(0xffffffff);
    const __m512i front = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11),
                  back = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
    const philox::Rounds rounds(d, 0);
    std::size_t i = 0;
    for (; i + 2 * philox::lanes <= count; i += 2 * philox::lanes) {
        __m512i words[1][4];
        philox::blocks(rounds, first + static_cast<std::uint32_t>(i / 2), words);
        const auto& w = words[0];
        const __m512i a = _mm512_or_epi64(_mm512_maskz_slli_epi64(philox::all_lanes, w[0], 32),
                                          _mm512_and_epi64(w[1], low));
        const __m512i b = _mm512_or_epi64(_mm512_maskz_slli_epi64(philox::all_lanes, w[2], 32),
                                          _mm512_and_epi64(w[3], low));
        _mm512_storeu_si512(out + i, _mm512_permutex2var_epi64(a, front, b));
        _mm512_storeu_si512(out + i + 8, _mm512_permutex2var_epi64(a, back, b));
    }
    return i;
}
#endif

double to_unit(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view item, std::uint32_t stream)
    : key_(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ fnv1a(item)) + mix(stream + 0x9e3779b97f4a7c15u)) {}

double RandomStream::uniform(std::uint64_t cycle, std::uint32_t index, std::uint32_t draw) const {
    const auto [a, b] = words(philox::draw_of(key_, cycle, draw), index / 2);
    return to_unit(index % 2 ? b : a);
}

philox::InstructionSet philox::best_instruction_set() {
#ifdef FORAGE_AVX2
    if (__builtin_cpu_supports("avx512f")) return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
    return InstructionSet::scalar;
}

void philox::bits(InstructionSet set, const Draw& d, std::span<std::uint64_t> out, std::size_t first) {
    const auto pair = static_cast<std::uint32_t>(first / 2);
    std::size_t i = 0;
#ifdef FORAGE_AVX2
    if (set == InstructionSet::avx512)
        i = words_by_wide_lanes(d, pair, out.data(), out.size());
    else if (set == InstructionSet::avx2)
        i = words_by_lanes(d, pair, out.data(), out.size());
#else
    static_cast<void>(set);
#endif
    for (; i < out.size(); i += 2) {
        const auto [a, b] = words(d, pair + static_cast<std::uint32_t>(i / 2));
        out[i] = a;
        if (i + 1 < out.size()) out[i + 1] = b;
    }
}

void RandomStream::bits(std::uint64_t cycle, std::span<std::uint64_t> out) const {
    static const auto set = philox::best_instruction_set();
    philox::bits(set, philox::draw_of(key_, cycle, 0), out);
}

void RandomStream::uniform(std::uint64_t cycle, std::span<double> out, std::uint32_t draw,
                           std::size_t first) const {
    static const auto set = philox::best_instruction_set();
    const Draw d = philox::draw_of(key_, cycle, draw);
    std::array<std::uint64_t, 256> words;
    for (std::size_t i = 0; i < out.size(); i += words.size()) {
        const std::size_t count = std::min(words.size(), out.size() - i);
        philox::bits(set, d, {words.data(), count}, first + i);
        for (std::size_t k = 0; k < count; ++k) out[i + k] = to_unit(words[k]);
    }
}

void RandomStream::normal(std::uint64_t cycle, std::span<double> out) const {
    static const auto set = philox::best_instruction_set();
    const Draw d = philox::draw_of(key_, cycle, 0);
    std::array<std::uint64_t, 64> words;
    for (std::size_t first = 0; first < out.size(); first += words.size()) {
        const std::size_t count = std::min(words.size(), out.size() - first);
        philox::bits(set, d, {words.data(), count + count % 2}, first);
        for (std::size_t i = 0; i < count; i += 2) {
            const double radius = std::sqrt(-2 * std::log(1 - to_unit(words[i])));  // 1 - u is in (0, 1]
            const double angle = 2 * std::numbers::pi * to_unit(words[i + 1]);
            out[first + i] = radius * std::cos(angle);
            if (i + 1 < count) out[first + i + 1] = radius * std::sin(angle);
        }
    }
}

}  // namespace forage
