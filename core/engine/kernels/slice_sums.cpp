#include "core/engine/kernels/slice_sums.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "core/base/simd.h"

namespace forage::engine {
namespace {

constexpr std::size_t lanes = Slices::lanes, half = Slices::half;

/// Loading single numbers takes the time, so that wider vectors gain nothing.
typedef double Half __attribute__((vector_size(half * sizeof(double))));      // NOLINT: no `using` for this
typedef double Pair __attribute__((vector_size(half / 2 * sizeof(double))));  // NOLINT
static_assert(half == 4 && std::endian::native == std::endian::little);

struct TwoPlaces {
    std::size_t first, second;
};
/// Places are read two at a time and taken apart: fewer loads.
[[gnu::always_inline]] inline TwoPlaces two(const std::uint16_t* places) {
    std::uint32_t word;
    std::memcpy(&word, places, sizeof word);
    return {static_cast<std::uint16_t>(word), word >> 16};
}
[[gnu::always_inline]] inline TwoPlaces two(const std::uint32_t* places) { return {places[0], places[1]}; }

template <class Place>
[[gnu::always_inline]] inline void gather(const double* from, const Place* places, Half& to) {
    const auto a = two(places), b = two(places + 2);
    // In pairs: GCC 12 puts four single numbers one by one into a register, and waits for what was in it.
    const Pair low{from[a.first], from[a.second]}, high{from[b.first], from[b.second]};
#if __has_builtin(__builtin_shufflevector)
    to = __builtin_shufflevector(low, high, 0, 1, 2, 3);
#else
    to = Half{low[0], low[1], high[0], high[1]};
#endif
}

[[gnu::always_inline]] inline void scatter(const Half& from, const std::uint16_t* places, double* to) {
    for (std::size_t l = 0; l < half; ++l) to[places[l]] = from[l];
}

/// How far ahead of what is summed weights and places are fetched, in synapses. Into the second cache:
/// fetches that go straight into the nearest wait for each other.
constexpr std::size_t ahead = 320;

[[gnu::always_inline]] inline void fetch(const void* address) { __builtin_prefetch(address, 0, 2); }

/// The rows of entries that are still to be read.
template <bool weighted, class Cell>
struct Rows {
    const Cell* pre;
    const double* weights[2];  ///< of the halves

    /// halves[i] += what n rows deliver. Each row fetches its own, though two share a line of the cache: a
    /// fetch is given up when too many are under way, and the second one may not be.
    template <std::size_t n>
    [[gnu::always_inline]] void add(const double* scaled, Half (&halves)[2]) {
        for (std::size_t row = 0; row < n; ++row) {
            fetch(pre + row * lanes + ahead);
            if constexpr (weighted)
                for (const double* w : weights) fetch(w + row * half + ahead / lanes * half);
            for (std::size_t i = 0; i < 2; ++i) {
                Half psp;
                gather(scaled, pre + row * lanes + i * half, psp);
                if constexpr (weighted) {
                    Half weight;
                    std::memcpy(&weight, weights[i] + row * half, sizeof weight);
                    psp *= weight;
                }
                halves[i] += psp;
            }
        }
        pre += n * lanes;
        if constexpr (weighted) {
            for (auto& w : weights) w += n * half;
            asm("" : "+r"(pre), "+r"(weights[0]), "+r"(weights[1]));  // each an address, not anew by each row
        }
    }
};

template <bool weighted, class Cell>
[[gnu::always_inline]] inline void add_panel(SliceStream<Cell> s, double* sums) {
    Rows<weighted, Cell> rows{s.pre, {s.weights[0], s.weights[1]}};
    for (; s.run < s.end; ++s.run) {
        const double* scaled = s.scaled + s.run->block * s.stride;
        asm("" : "+r"(scaled));  // one address, not an addition for each place
        const std::size_t entries = std::size_t{s.run->length} * lanes;
        for (std::size_t slice = 0; slice < s.run->slices; ++slice, s.targets += lanes) {
            Half halves[2];
            gather(sums, s.targets, halves[0]), gather(sums, s.targets + half, halves[1]);
            const Cell* end = rows.pre + entries;
            if (s.run->length % 2) rows.template add<1>(scaled, halves);
            while (rows.pre < end) rows.template add<2>(scaled, halves);
            scatter(halves[0], s.targets, sums), scatter(halves[1], s.targets + half, sums);
        }
    }
}

template <class Cell>
[[gnu::always_inline]] inline void add_any(const SliceStream<Cell>& s, double* sums) {
    if (s.weights[0])
        add_panel<true>(s, sums);
    else
        add_panel<false>(s, sums);
}

}  // namespace

FORAGE_SIMD void add_stream(const SliceStream<std::uint16_t>& s, double* sums) { add_any(s, sums); }
FORAGE_SIMD void add_stream(const SliceStream<std::uint32_t>& s, double* sums) { add_any(s, sums); }

FORAGE_SIMD void add_sums(const double* sums, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] += sums[i];
}

}  // namespace forage::engine
