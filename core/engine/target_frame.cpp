#include "core/engine/target_frame.h"

#include <cstdint>
#include <cstring>

#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr Index lanes = TargetFrame::lanes;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));        // NOLINT: no `using` for this
typedef std::int64_t Mask __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT

FORAGE_SIMD void gather_runs(const Run* run, const Run* last, const double* cells, double* places) {
    for (; run != last; ++run) {
        const double* from = cells + run->target;
        for (Index i = 0; i < run->size; i += lanes, places += lanes)
            std::memcpy(places, from + i, sizeof(Lanes));
    }
}

/// Writes places to the cells of runs, or adds them.
template <bool add>
[[gnu::always_inline]] inline void write_runs(const Run* run, const Run* last, const double* places,
                                              double* cells) {
    const Mask lane = {0, 1, 2, 3};
    for (; run != last; ++run) {
        double* to = cells + run->target;
        for (Index left = run->size; left > 0; left -= lanes, to += lanes, places += lanes) {
            Lanes cell, place;
            std::memcpy(&cell, to, sizeof cell);
            std::memcpy(&place, places, sizeof place);
            if (add) place += cell;
            if (left < lanes) place = lane < Mask{left, left, left, left} ? place : cell;
            std::memcpy(to, &place, sizeof place);
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
    if (!runs_.empty()) return gather_runs(&runs_[part.first], &runs_[part.first] + (part.last - part.first), cells, places);
    for (std::size_t i = part.first; i < part.last; ++i) *places++ = cells[cells_[i]];
}

void TargetFrame::scatter(Part part, const double* places, double* cells) const {
    if (!runs_.empty()) return scatter_runs(&runs_[part.first], &runs_[part.first] + (part.last - part.first), places, cells);
    for (std::size_t i = part.first; i < part.last; ++i) cells[cells_[i]] = *places++;
}

void TargetFrame::add(Part part, const double* places, double* cells) const {
    if (!runs_.empty()) return add_runs(&runs_[part.first], &runs_[part.first] + (part.last - part.first), places, cells);
    for (std::size_t i = part.first; i < part.last; ++i) cells[cells_[i]] += *places++;
}

}  // namespace forage::engine
