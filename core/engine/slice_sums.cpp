#include "core/engine/slice_sums.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr std::size_t lanes = Slices::lanes, half = Slices::half;

/// Loading single numbers takes the time, so that wider vectors gain nothing.
typedef double Half __attribute__((vector_size(half * sizeof(double))));  // NOLINT: no `using` for this
static_assert(half == 4 && std::endian::native == std::endian::little);

/// The i-th of the places in `words`.
template <class Place>
[[gnu::always_inline]] inline std::size_t place(const std::uint32_t* words, std::size_t i) {
    constexpr std::size_t bits = 8 * sizeof(Place), in_word = sizeof *words / sizeof(Place);
    return static_cast<Place>(words[i / in_word] >> i % in_word * bits);
}

/// Places are read two at a time and taken apart: fewer loads.
template <class Place>
[[gnu::always_inline]] inline void gather(const double* from, const Place* places, Half& to) {
    std::uint32_t words[half * sizeof(Place) / sizeof(std::uint32_t)];
    std::memcpy(words, places, sizeof words);
    to = Half{from[place<Place>(words, 0)], from[place<Place>(words, 1)], from[place<Place>(words, 2)],
              from[place<Place>(words, 3)]};
}

[[gnu::always_inline]] inline void scatter(const Half& from, const std::uint16_t* places, double* to) {
    for (std::size_t l = 0; l < half; ++l) to[places[l]] = from[l];
}

/// How far ahead of what is summed weights and places are fetched, in synapses. Into the second cache:
/// fetches that go straight into the nearest wait for each other.
constexpr std::size_t ahead = 320;

[[gnu::always_inline]] inline void fetch(const void* address) { __builtin_prefetch(address, 0, 2); }

/// sum += what a half of a row of entries delivers.
template <bool weighted, class Cell>
[[gnu::always_inline]] inline void add_half(const SliceStream<Cell>& s, const double* scaled,
                                            std::size_t entry, std::size_t which, Half& sum) {
    Half psp;
    gather(scaled, s.pre + entry + which * half, psp);
    if constexpr (weighted) {
        const double* from = s.weights[which] + entry / lanes * half;
        fetch(from + ahead / lanes * half);
        Half weight;
        std::memcpy(&weight, from, sizeof weight);
        psp *= weight;
    }
    sum += psp;
}

template <bool weighted, class Cell>
[[gnu::always_inline]] inline void add_panel(SliceStream<Cell> s, double* sums) {
    std::size_t entry = 0;
    for (; s.run < s.end; ++s.run) {
        const double* scaled = s.scaled + s.run->block * s.stride;
        asm("" : "+r"(scaled));  // one address, not an addition for each place
        const std::size_t entries = std::size_t{s.run->length} * lanes;
        for (std::size_t slice = 0; slice < s.run->slices; ++slice, s.targets += lanes) {
            Half first, second;
            gather(sums, s.targets, first), gather(sums, s.targets + half, second);
            for (const std::size_t end = entry + entries; entry < end; entry += lanes) {
                fetch(s.pre + entry + ahead);
                add_half<weighted>(s, scaled, entry, 0, first);
                add_half<weighted>(s, scaled, entry, 1, second);
            }
            scatter(first, s.targets, sums), scatter(second, s.targets + half, sums);
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
