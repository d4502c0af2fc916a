// Blocks of Philox4x32-10 for the random streams, one or eight at a time. Not for types.
#pragma once

#include <cstddef>
#include <cstdint>

#include <Random123/philox.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define FORAGE_AVX2 __attribute__((target("avx2")))
#endif

namespace forage::philox {

inline constexpr std::size_t lanes = 8;

/// What the blocks of one draw have in common.
struct Draw {
    std::uint32_t key[2], cycle[2], draw;
};

inline Draw draw_of(std::uint64_t key, std::uint64_t cycle, std::uint32_t draw) {
    return {{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)},
            {static_cast<std::uint32_t>(cycle), static_cast<std::uint32_t>(cycle >> 32)},
            draw};
}

/// `stream` tells apart uses of one draw.
inline r123::Philox4x32::ctr_type block(const Draw& d, std::uint32_t index, std::uint32_t stream) {
    return r123::Philox4x32{}({{index, d.cycle[0], d.cycle[1], d.draw | stream}}, {{d.key[0], d.key[1]}});
}

#ifdef FORAGE_AVX2

inline bool eight_at_a_time() { return __builtin_cpu_supports("avx2"); }

FORAGE_AVX2 inline __m256i all(std::uint32_t v) { return _mm256_set1_epi32(static_cast<int>(v)); }

struct Product {
    __m256i low, high;
};

FORAGE_AVX2 inline Product multiply(__m256i a, __m256i factor) {
    const __m256i even = _mm256_mul_epu32(a, factor),
                  odd = _mm256_mul_epu32(_mm256_srli_epi64(a, 32), factor);
    return {_mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa),
            _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa)};
}

/// Word j of block `first` + l is lane l of words[j].
FORAGE_AVX2 inline void blocks(const Draw& d, std::uint32_t first, std::uint32_t stream, __m256i* words) {
    __m256i c0 = _mm256_add_epi32(all(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    __m256i c1 = all(d.cycle[0]), c2 = all(d.cycle[1]), c3 = all(d.draw | stream);
    std::uint32_t k0 = d.key[0], k1 = d.key[1];
    for (int round = 0; round < 10; ++round, k0 += 0x9e3779b9u, k1 += 0xbb67ae85u) {
        const Product p = multiply(c0, all(0xd2511f53u)), q = multiply(c2, all(0xcd9e8d57u));
        c0 = _mm256_xor_si256(_mm256_xor_si256(q.high, c1), all(k0));
        c2 = _mm256_xor_si256(_mm256_xor_si256(p.high, c3), all(k1));
        c1 = q.low, c3 = p.low;
    }
    words[0] = c0, words[1] = c1, words[2] = c2, words[3] = c3;
}

#else

inline bool eight_at_a_time() { return false; }

#endif

}  // namespace forage::philox
