// Random events at a probability, many cells at a time.
//
// A cell gets 16 random bits, which are compared with the upper 16 of the probability's 53; where these are
// equal, once in 65536 times, the lower 37 decide. So 8 cells share a block of Philox, where uniform numbers
// take 4.
//
// 64 cells are a batch: its 8 blocks are lanes l = 0..7, and half m of word j of block l belongs to cell
// 8 (2 j + m) + l. Then vectors of 8 lanes give 8 cells that are neighbours.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/types/philox.h"
#include "core/types/random.h"

namespace forage {
namespace {

using philox::Draw;

constexpr std::size_t lanes = philox::lanes, batch = 8 * lanes;
constexpr std::uint32_t events_stream = 0x80000000u,
                        ties_stream = 0xc0000000u;  // apart from those of uniform()

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

/// The same numbers as batch_by_cell().
FORAGE_AVX2 void batch_by_lanes(const Draw& d, std::size_t number, const Threshold& t, double value,
                                double* out) {
    __m256i words[4];
    philox::blocks(d, static_cast<std::uint32_t>(number * lanes), events_stream, words);
    const __m256i top = philox::all(t.top);
    const __m256d active = _mm256_set1_pd(value);
    __m256i ties = _mm256_setzero_si256();
    for (int part = 0; part < 8; ++part, out += lanes) {
        const __m256i word = words[part / 2];
        const __m256i bits =
            part % 2 ? _mm256_srli_epi32(word, 16) : _mm256_and_si256(word, philox::all(0xffffu));
        const __m256i above = _mm256_cmpgt_epi32(bits, top);
        ties = _mm256_or_si256(ties, _mm256_cmpeq_epi32(bits, top));
        const __m256i low = _mm256_cvtepi32_epi64(_mm256_castsi256_si128(above));
        const __m256i high = _mm256_cvtepi32_epi64(_mm256_extracti128_si256(above, 1));
        _mm256_storeu_pd(out, _mm256_and_pd(active, _mm256_castsi256_pd(low)));
        _mm256_storeu_pd(out + 4, _mm256_and_pd(active, _mm256_castsi256_pd(high)));
    }
    if (!_mm256_testz_si256(ties, ties)) batch_by_cell(d, number, t, value, out - batch);
}

/// The same for `many` batches.
template <int many>
FORAGE_AVX512 void batches_by_wide_lanes(const Draw& d, const philox::WideKeys& keys, std::size_t number,
                                         const Threshold& t, double value, double* out) {
    __m512i words[many][4];
    philox::blocks(d, keys, static_cast<std::uint32_t>(number * lanes), events_stream, words);
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

/// `count` batches from the `number`-th on.
void batches(philox::Way way, const Draw& d, std::size_t number, std::size_t count, const Threshold& t,
             double value, double* out) {
#ifdef FORAGE_AVX2
    if (way == philox::Way::avx512) {
        const philox::WideKeys keys(d);
        constexpr std::size_t together = 2;
        for (; count >= together; number += together, count -= together, out += together * batch)
            batches_by_wide_lanes<together>(d, keys, number, t, value, out);
        for (; count > 0; ++number, --count, out += batch)
            batches_by_wide_lanes<1>(d, keys, number, t, value, out);
        return;
    }
    if (way == philox::Way::avx2) {
        for (; count > 0; ++number, --count, out += batch) batch_by_lanes(d, number, t, value, out);
        return;
    }
#endif
    static_cast<void>(way);
    for (; count > 0; ++number, --count, out += batch) batch_by_cell(d, number, t, value, out);
}

}  // namespace

void RandomStream::events(std::uint64_t cycle, double probability, std::span<double> out, double value,
                          std::uint32_t draw, std::size_t first) const {
    static_assert(grain == batch);
    static const auto way = philox::fastest_way();
    philox::events(way, philox::draw_of(key_, cycle, draw), probability, out, value, first);
}

void philox::events(Way way, const Draw& d, double probability, std::span<double> out, double value,
                    std::size_t first) {
    const Threshold threshold(probability);
    const std::size_t whole = out.size() / batch, before = first / batch;
    batches(way, d, before, whole, threshold, value, out.data());
    if (const std::size_t left = out.size() % batch) {
        std::array<double, batch> last;
        batches(way, d, before + whole, 1, threshold, value, last.data());
        std::copy_n(last.begin(), left, out.end() - static_cast<std::ptrdiff_t>(left));
    }
}

}  // namespace forage
