// Blocks of Philox4x32-10 for the random streams, one or eight at a time, and what is made of many. Not for
// types.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Random123/philox.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define FORAGE_AVX2 __attribute__((target("avx2")))
#define FORAGE_AVX512 __attribute__((target("avx512f")))
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

/// Ways to compute. All give the same numbers.
enum class Way { one_by_one, avx2, avx512 };
/// The fastest that this processor can go.
Way fastest_way();

/// RandomStream::bits() for any draw, from number `first` on, which is even.
void bits(Way way, const Draw& draw, std::span<std::uint64_t> out, std::size_t first = 0);
/// RandomStream::events().
void events(Way way, const Draw& draw, double probability, std::span<double> out, double value,
            std::size_t first);

/// `stream` tells apart uses of one draw.
inline r123::Philox4x32::ctr_type block(const Draw& d, std::uint32_t index, std::uint32_t stream) {
    return r123::Philox4x32{}({{index, d.cycle[0], d.cycle[1], d.draw | stream}}, {{d.key[0], d.key[1]}});
}

#ifdef FORAGE_AVX2

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

// The forms with a mask, of all lanes: GCC 12 warns of what the plain ones leave undefined. No mask is left
// in the code.
inline constexpr unsigned char all_lanes = 0xff;
FORAGE_AVX512 inline __m512i wide(std::uint32_t v) { return _mm512_set1_epi64(v); }
FORAGE_AVX512 inline __m512i upper(__m512i v) { return _mm512_maskz_srli_epi64(all_lanes, v, 32); }
FORAGE_AVX512 inline __m512i product(__m512i a, std::uint32_t factor) {
    return _mm512_maskz_mul_epu32(all_lanes, a, wide(factor));
}

/// What the rounds add, for many blocks of one draw.
struct WideKeys {
    std::uint64_t k0[10], k1[10];
    explicit WideKeys(const Draw& d) {
        for (std::uint32_t round = 0; round < 10; ++round) {
            k0[round] = d.key[0] + round * 0x9e3779b9u;
            k1[round] = d.key[1] + round * 0xbb67ae85u;
        }
    }
};

/// The low half of lane l of words[i][j] is word j of block `first` + 8 i + l; the high half is anything.
/// Rounds wait for each other, so several are computed side by side.
template <int many>
FORAGE_AVX512 inline void blocks(const Draw& d, const WideKeys& keys, std::uint32_t first,
                                 std::uint32_t stream, __m512i (&words)[many][4]) {
    constexpr int exclusive_or = 0x96;  // of all three
    for (int i = 0; i < many; ++i) {
        words[i][0] = _mm512_add_epi64(wide(first + 8u * static_cast<std::uint32_t>(i)),
                                       _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7));
        words[i][1] = wide(d.cycle[0]), words[i][2] = wide(d.cycle[1]), words[i][3] = wide(d.draw | stream);
    }
#pragma GCC unroll 10
    for (int round = 0; round < 10; ++round) {
        const __m512i k0 = _mm512_set1_epi64(static_cast<long long>(keys.k0[round])),
                      k1 = _mm512_set1_epi64(static_cast<long long>(keys.k1[round]));
#pragma GCC unroll 4
        for (auto& c : words) {
            const __m512i p = product(c[0], 0xd2511f53u), q = product(c[2], 0xcd9e8d57u);
            c[0] = _mm512_ternarylogic_epi64(upper(q), c[1], k0, exclusive_or);
            c[2] = _mm512_ternarylogic_epi64(upper(p), c[3], k1, exclusive_or);
            c[1] = q, c[3] = p;
        }
    }
}

#endif

}  // namespace forage::philox
