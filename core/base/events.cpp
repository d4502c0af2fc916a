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

namespace forage {
namespace {

using philox::Draw;

constexpr std::size_t lanes = philox::lanes, batch = 8 * lanes;
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

void batch_by_cell(const Draw& d, std::size_t number, const Threshold& t, double value, double* out) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto words = philox::block(d, static_cast<std::uint32_t>(number * lanes + lane), events_stream);
        for (std::size_t part = 0; part < 8; ++part) {
            const std::uint32_t bits = words[part / 2] >> 16 * (part % 2) & 0xffffu;
            const std::size_t cell = part * lanes + lane;
            const bool active = bits > t.top || (bits == t.top && tie_is_active(d, number * batch + cell, t));
            out[cell] = active ? value : 0.0;
        }
    }
}

#ifdef FORAGE_AVX2

/// Computes `count` batches, with the same numbers as batch_by_cell().
FORAGE_AVX2 void batches_by_lanes(const Draw& d, std::size_t number, std::size_t count, const Threshold& t,
                                  double value, double* out) {
    const philox::Rounds rounds(d, events_stream);
    // 16 cells are compared at a time, as signed numbers. No cell is equal to or above a `top` of 65536.
    const __m256i sign = _mm256_set1_epi16(-0x8000);
    const __m256i top = _mm256_set1_epi16(static_cast<short>(std::min(t.top, 0xffffu) - 0x8000u));
    const __m256d active = _mm256_set1_pd(t.top <= 0xffffu ? value : 0.0);
    // Shuffles that widen masks from 16 to 64 bits, for the low and the high halves of blocks 0 to 3, then of
    // 4 to 7.
    const __m256i lane = _mm256_setr_epi64x(0, 0x0808080808080808, 0, 0x0808080808080808);
    __m256i picks[4];
    for (int i = 0; i < 4; ++i)
        picks[i] = _mm256_or_si256(lane, _mm256_set1_epi16(static_cast<short>(0x0100 + 0x0202 * i)));
    constexpr std::size_t cells[4] = {0, lanes, 4, lanes + 4};

    for (; count > 0; ++number, --count) {
        __m256i words[2][4];
        philox::blocks(rounds, static_cast<std::uint32_t>(number * lanes), words);
        __m256i ties = _mm256_setzero_si256();
        for (int word = 0; word < 4; ++word, out += 2 * lanes) {
            const __m256i both =
                _mm256_blend_epi32(words[0][word], _mm256_slli_epi64(words[1][word], 32), 0xaa);
            const __m256i bits = _mm256_xor_si256(both, sign);
            const __m256i above = _mm256_cmpgt_epi16(bits, top);
            ties = _mm256_or_si256(ties, _mm256_cmpeq_epi16(bits, top));
            for (int i = 0; i < 4; ++i) {
                const __m256i mask = _mm256_shuffle_epi8(above, picks[i]);
                _mm256_storeu_pd(out + cells[i], _mm256_and_pd(active, _mm256_castsi256_pd(mask)));
            }
        }
        if (!_mm256_testz_si256(ties, ties)) batch_by_cell(d, number, t, value, out - batch);
    }
}

/// Computes `many` batches at a time.
template <int many>
FORAGE_AVX512 void batches_by_wide_lanes(const Draw& d, const philox::Rounds& rounds, std::size_t number,
                                         const Threshold& t, double value, double* out) {
    __m512i words[many][4];
    philox::blocks(rounds, static_cast<std::uint32_t>(number * lanes), words);
    const __m512i top = _mm512_set1_epi64(t.top), half = _mm512_set1_epi64(0xffff);
    const __m512d active = _mm512_set1_pd(value);
    for (const auto& batch_words : words) {
        unsigned ties = 0;
        for (int part = 0; part < 8; ++part, out += lanes) {
            const __m512i word = batch_words[part / 2];
            const __m512i bits = _mm512_and_epi64(
                part % 2 ? _mm512_maskz_srli_epi64(philox::all_lanes, word, 16) : word, half);
            ties |= _mm512_cmpeq_epi64_mask(bits, top);
            _mm512_storeu_pd(out, _mm512_maskz_mov_pd(_mm512_cmpgt_epi64_mask(bits, top), active));
        }
        if (ties) batch_by_cell(d, number, t, value, out - batch);
        ++number;
    }
}

#endif

/// Computes `count` batches, beginning with the `number`-th.
void batches(philox::InstructionSet set, const Draw& d, std::size_t number, std::size_t count,
             const Threshold& t, double value, double* out) {
#ifdef FORAGE_AVX2
    if (set == philox::InstructionSet::avx512) {
        const philox::Rounds rounds(d, events_stream);
        constexpr std::size_t together = 2;
        for (; count >= together; number += together, count -= together, out += together * batch)
            batches_by_wide_lanes<together>(d, rounds, number, t, value, out);
        for (; count > 0; ++number, --count, out += batch)
            batches_by_wide_lanes<1>(d, rounds, number, t, value, out);
        return;
    }
    if (set == philox::InstructionSet::avx2) return batches_by_lanes(d, number, count, t, value, out);
#endif
    static_cast<void>(set);
    for (; count > 0; ++number, --count, out += batch) batch_by_cell(d, number, t, value, out);
}

}  // namespace

void RandomStream::events(std::uint64_t cycle, double probability, std::span<double> out, double value,
                          std::uint32_t draw, std::size_t first) const {
    static_assert(grain == batch);
    static const auto set = philox::best_instruction_set();
    philox::events(set, philox::draw_of(key_, cycle, draw), probability, out, value, first);
}

void philox::events(InstructionSet set, const Draw& d, double probability, std::span<double> out,
                    double value, std::size_t first) {
    const Threshold threshold(probability);
    const std::size_t whole = out.size() / batch, before = first / batch;
    batches(set, d, before, whole, threshold, value, out.data());
    if (const std::size_t left = out.size() % batch) {
        std::array<double, batch> last;
        batches(set, d, before + whole, 1, threshold, value, last.data());
        std::copy_n(last.begin(), left, out.end() - static_cast<std::ptrdiff_t>(left));
    }
}

}  // namespace forage
