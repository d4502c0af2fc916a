// Blocks of Philox4x32-10 for the random streams, one or several at a time. Types do not use this header.
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

/// The values that all blocks of one draw share.
struct Draw {
    std::uint32_t key[2], cycle[2], draw;
};

inline Draw draw_of(std::uint64_t key, std::uint64_t cycle, std::uint32_t draw) {
    return {{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)},
            {static_cast<std::uint32_t>(cycle), static_cast<std::uint32_t>(cycle >> 32)},
            draw};
}

/// The instructions of an implementation. All implementations give the same numbers.
enum class InstructionSet { scalar, avx2, avx512 };
/// The largest set that this processor supports.
InstructionSet best_instruction_set();

/// Computes RandomStream::bits() for any draw, beginning with number `first`, which must be even.
void bits(InstructionSet set, const Draw& draw, std::span<std::uint64_t> out, std::size_t first = 0);
/// Computes RandomStream::events() for any draw.
void events(InstructionSet set, const Draw& draw, double probability, std::span<double> out, double value,
            std::size_t first);

/// Computes one block. `stream` separates different uses of one draw.
inline r123::Philox4x32::ctr_type block(const Draw& d, std::uint32_t index, std::uint32_t stream) {
    return r123::Philox4x32{}({{index, d.cycle[0], d.cycle[1], d.draw | stream}}, {{d.key[0], d.key[1]}});
}

#ifdef FORAGE_AVX2

inline constexpr std::uint32_t multipliers[] = {0xd2511f53u, 0xcd9e8d57u};

/// The values that the rounds of many blocks share. Their counters differ only in the first word, so half of
/// the first round and the other half of the second round are the same for all blocks. They are computed
/// here, once.
struct Rounds {
    static constexpr int left = 8;               ///< number of rounds after the first two
    alignas(32) std::uint64_t keys[left][2][4];  ///< each key four times, as vectors read them
    std::uint64_t second, third[2], fourth;

    Rounds(const Draw& d, std::uint32_t stream) {
        const auto key = [&](int round, int i) {
            return d.key[i] + static_cast<std::uint32_t>(round) * (i == 0 ? 0x9e3779b9u : 0xbb67ae85u);
        };
        const std::uint64_t q = std::uint64_t{d.cycle[1]} * multipliers[1];
        const std::uint64_t first = (q >> 32) ^ d.cycle[0] ^ key(0, 0);
        const std::uint64_t p = (first & 0xffffffffu) * multipliers[0];
        second = (d.draw | stream) ^ key(0, 1);
        third[0] = (q & 0xffffffffu) ^ key(1, 0);
        third[1] = (p >> 32) ^ key(1, 1);
        fourth = p;
        for (int round = 0; round < left; ++round)
            for (int i = 0; i < 2; ++i)
                for (auto& k : keys[round][i]) k = key(round + 2, i);
    }
};

FORAGE_AVX2 inline __m256i all(std::uint64_t v) { return _mm256_set1_epi64x(static_cast<long long>(v)); }

/// Computes 4 * `many` blocks. The low half of lane l of words[i][j] is word j of block `first` + 4 i + l.
/// The high half is undefined, so that a product of low halves needs no blending. Each round depends on the
/// one before, so several blocks are computed side by side.
template <int many>
FORAGE_AVX2 inline void blocks(const Rounds& rounds, std::uint32_t first, __m256i (&words)[many][4]) {
    const __m256i m0 = all(multipliers[0]), m1 = all(multipliers[1]);
    for (int i = 0; i < many; ++i) {
        const __m256i index =
            _mm256_add_epi64(all(first + 4u * static_cast<std::uint32_t>(i)), _mm256_setr_epi64x(0, 1, 2, 3));
        const __m256i p = _mm256_mul_epu32(index, m0);
        const __m256i q =
            _mm256_mul_epu32(_mm256_xor_si256(_mm256_srli_epi64(p, 32), all(rounds.second)), m1);
        words[i][0] = _mm256_xor_si256(_mm256_srli_epi64(q, 32), all(rounds.third[0]));
        words[i][1] = q;
        words[i][2] = _mm256_xor_si256(p, all(rounds.third[1]));
        words[i][3] = all(rounds.fourth);
    }
#pragma GCC unroll 8
    for (const auto& key : rounds.keys) {
        const auto* k = reinterpret_cast<const __m256i*>(key);
#pragma GCC unroll 4
        for (auto& c : words) {
            const __m256i p = _mm256_mul_epu32(c[0], m0), q = _mm256_mul_epu32(c[2], m1);
            c[0] = _mm256_xor_si256(_mm256_srli_epi64(q, 32), _mm256_xor_si256(c[1], k[0]));
            c[2] = _mm256_xor_si256(_mm256_srli_epi64(p, 32), _mm256_xor_si256(c[3], k[1]));
            c[1] = q, c[3] = p;
        }
    }
}

// These functions use the intrinsics with a mask, and set all lanes in it, because GCC 12 warns about
// undefined values in the intrinsics without a mask. The generated code has no mask.
inline constexpr unsigned char all_lanes = 0xff;
FORAGE_AVX512 inline __m512i wide(std::uint64_t v) { return _mm512_set1_epi64(static_cast<long long>(v)); }
FORAGE_AVX512 inline __m512i upper(__m512i v) { return _mm512_maskz_srli_epi64(all_lanes, v, 32); }
FORAGE_AVX512 inline __m512i product(__m512i a, std::uint32_t factor) {
    return _mm512_maskz_mul_epu32(all_lanes, a, wide(factor));
}

/// Computes 8 * `many` blocks, in vectors with eight lanes.
template <int many>
FORAGE_AVX512 inline void blocks(const Rounds& rounds, std::uint32_t first, __m512i (&words)[many][4]) {
    constexpr int exclusive_or = 0x96;  // the exclusive or of three operands
    for (int i = 0; i < many; ++i) {
        const __m512i index = _mm512_add_epi64(wide(first + 8u * static_cast<std::uint32_t>(i)),
                                               _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7));
        const __m512i p = product(index, multipliers[0]);
        const __m512i q = product(upper(p) ^ wide(rounds.second), multipliers[1]);
        words[i][0] = upper(q) ^ wide(rounds.third[0]), words[i][1] = q;
        words[i][2] = p ^ wide(rounds.third[1]), words[i][3] = wide(rounds.fourth);
    }
#pragma GCC unroll 8
    for (const auto& key : rounds.keys) {
        const __m512i k0 = wide(key[0][0]), k1 = wide(key[1][0]);
#pragma GCC unroll 4
        for (auto& c : words) {
            const __m512i p = product(c[0], multipliers[0]), q = product(c[2], multipliers[1]);
            c[0] = _mm512_ternarylogic_epi64(upper(q), c[1], k0, exclusive_or);
            c[2] = _mm512_ternarylogic_epi64(upper(p), c[3], k1, exclusive_or);
            c[1] = q, c[3] = p;
        }
    }
}

#endif

}  // namespace forage::philox
