#include "core/engine/slice_sums.h"

#include <cstring>

#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr std::size_t lanes = Slices::lanes;

/// Half of a slice: loading single numbers takes the time, so that wider vectors gain nothing.
constexpr std::size_t half = lanes / 2;
typedef double Half __attribute__((vector_size(half * sizeof(double))));  // NOLINT: no `using` for this

template <class Place>
[[gnu::always_inline]] inline void gather(const double* from, const Place* places, Half& to) {
    to = Half{from[places[0]], from[places[1]], from[places[2]], from[places[3]]};
}

[[gnu::always_inline]] inline void scatter(const Half& from, const std::uint16_t* places, double* to) {
    for (std::size_t l = 0; l < half; ++l) to[places[l]] = from[l];
}

/// Reads ahead of what is summed, further than the processor does by itself. Into the second cache: those
/// that go straight into the nearest wait for each other.
[[gnu::always_inline]] inline void fetch(const void* address) { __builtin_prefetch(address, 0, 2); }

/// sum += what half of a row of entries delivers.
template <bool weighted, class Cell>
[[gnu::always_inline]] inline void add_half(const SliceStream<Cell>& s, const double* scaled,
                                            std::size_t entry, Half& sum) {
    Half psp;
    gather(scaled, s.pre + entry, psp);
    if constexpr (weighted) {
        Half weight;
        std::memcpy(&weight, s.weight + entry, sizeof weight);
        psp *= weight;
    }
    sum += psp;
}

template <bool weighted, class Cell>
[[gnu::always_inline]] inline void add_panel(SliceStream<Cell> s, double* sums) {
    constexpr std::size_t ahead = 1024;  // synapses
    std::size_t entry = 0;
    for (; s.run < s.end; ++s.run) {
        const double* scaled = s.scaled + s.run->block * s.stride;
        asm("" : "+r"(scaled));  // one address, not an addition for each place
        const std::size_t entries = std::size_t{s.run->length} * lanes;
        for (std::size_t slice = 0; slice < s.run->slices; ++slice, s.targets += lanes) {
            fetch(s.targets + ahead);
            Half first, second;
            gather(sums, s.targets, first), gather(sums, s.targets + half, second);
            for (const std::size_t end = entry + entries; entry < end; entry += lanes) {
                fetch(s.pre + entry + 4 * ahead);
                if constexpr (weighted) fetch(s.weight + entry + ahead);
                add_half<weighted>(s, scaled, entry, first);
                add_half<weighted>(s, scaled, entry + half, second);
            }
            scatter(first, s.targets, sums), scatter(second, s.targets + half, sums);
        }
    }
}

template <class Cell>
[[gnu::always_inline]] inline void add_any(const SliceStream<Cell>& s, double* sums) {
    if (s.weight)
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
