#include "core/engine/target_frame.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr Index lanes = TargetFrame::lanes;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this
typedef std::int64_t Mask __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT

[[gnu::always_inline]] inline Index blocks_of(const Run& run) { return (run.size + lanes - 1) / lanes; }

// Runs of one connection are mostly of one length: loops over those of `blocks` vectors.

template <int blocks>
[[gnu::always_inline]] inline void gather_alike(const Run*& run, const Run* last, const double* cells,
                                                double*& places) {
    for (; run != last && blocks_of(*run) == blocks; ++run, places += blocks * lanes)
        std::memcpy(places, cells + run->target, blocks * sizeof(Lanes));
}

/// `add`: cells += places, else cells = places.
template <bool add, int blocks>
[[gnu::always_inline]] inline void write_alike(const Run*& run, const Run* last, const double*& places,
                                               double* cells) {
    for (; run != last && blocks_of(*run) == blocks; ++run, places += blocks * lanes) {
        double* to = cells + run->target;
        const Index left = run->size - (blocks - 1) * lanes;  // in the last block
        for (int b = 0; b < blocks; ++b) {
            Lanes cell, place;
            std::memcpy(&cell, to + b * lanes, sizeof cell);
            std::memcpy(&place, places + b * lanes, sizeof place);
            if (add) place += cell;
            if (b == blocks - 1) place = Mask{0, 1, 2, 3} < Mask{left, left, left, left} ? place : cell;
            std::memcpy(to + b * lanes, &place, sizeof place);
        }
    }
}

FORAGE_SIMD void gather_runs(const Run* run, const Run* last, const double* cells, double* places) {
    while (run != last) {
        gather_alike<1>(run, last, cells, places);
        gather_alike<2>(run, last, cells, places);
        gather_alike<3>(run, last, cells, places);
        gather_alike<4>(run, last, cells, places);
        for (; run != last && blocks_of(*run) > 4; places += blocks_of(*run) * lanes, ++run)
            std::copy_n(cells + run->target, run->size, places);
    }
}

template <bool add>
[[gnu::always_inline]] inline void write_runs(const Run* run, const Run* last, const double* places,
                                              double* cells) {
    while (run != last) {
        write_alike<add, 1>(run, last, places, cells);
        write_alike<add, 2>(run, last, places, cells);
        write_alike<add, 3>(run, last, places, cells);
        write_alike<add, 4>(run, last, places, cells);
        for (; run != last && blocks_of(*run) > 4; places += blocks_of(*run) * lanes, ++run) {
            double* to = cells + run->target;
            for (int i = 0; i < run->size; ++i) to[i] = add ? to[i] + places[i] : places[i];
        }
    }
}

FORAGE_SIMD void scatter_runs(const Run* run, const Run* last, const double* places, double* cells) {
    write_runs<false>(run, last, places, cells);
}

FORAGE_SIMD void add_runs(const Run* run, const Run* last, const double* places, double* cells) {
    write_runs<true>(run, last, places, cells);
}

}  // namespace

TargetFrame::TargetFrame(const SourceOrder& order) {
    Index synapses = 0, places = 0;
    for (const auto& s : order.sources)
        for (std::size_t r = s.first_run; r < s.last_run; ++r)
            synapses += order.runs[r].size, places += filled(order.runs[r].size);
    const bool long_runs = places <= 2 * synapses;
    std::vector<std::size_t> item{0};  // by run: its first item
    std::vector<Index> place;          // by run, counted from the first place of all
    Index next = 0;
    for (const Run& run : order.runs) {
        item.push_back(item.back() + (long_runs ? 1 : static_cast<std::size_t>(run.size)));
        place.push_back(next);
        next += long_runs ? filled(run.size) : run.size;
        if (!long_runs)
            for (int k = 0; k < run.size; ++k) cells_.push_back(run.target + k);
    }
    place.push_back(next);
    if (long_runs) runs_ = order.runs;
    for (const auto& s : order.sources)
        sources_.push_back({{item[s.first_run], item[s.last_run]},
                            place[s.first_run] - place[order.frames[s.frame].first_run],
                            place[s.last_run] - place[s.first_run]});
}

void TargetFrame::gather(Part part, const double* cells, double* places) const {
    if (!runs_.empty())
        return gather_runs(&runs_[part.first], &runs_[part.first] + (part.last - part.first), cells, places);
    for (std::size_t i = part.first; i < part.last; ++i) *places++ = cells[cells_[i]];
}

void TargetFrame::scatter(Part part, const double* places, double* cells) const {
    if (!runs_.empty())
        return scatter_runs(&runs_[part.first], &runs_[part.first] + (part.last - part.first), places, cells);
    for (std::size_t i = part.first; i < part.last; ++i) cells[cells_[i]] = *places++;
}

void TargetFrame::add(Part part, const double* places, double* cells) const {
    if (!runs_.empty())
        return add_runs(&runs_[part.first], &runs_[part.first] + (part.last - part.first), places, cells);
    for (std::size_t i = part.first; i < part.last; ++i) cells[cells_[i]] += *places++;
}

}  // namespace forage::engine
