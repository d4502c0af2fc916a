#include "core/engine/kernels/target_frame.h"

namespace forage::engine {

TargetFrame::TargetFrame(const SourceOrder& order) {
    std::vector<Index> place;  // of the first target of each run, in its frame
    for (const auto& frame : order.frames) {
        begin_.push_back(cells_.size());
        for (std::size_t r = frame.first_run; r < frame.last_run; ++r) {
            place.push_back(static_cast<Index>(cells_.size() - begin_.back()));
            for (int k = 0; k < order.runs[r].size; ++k) cells_.push_back(order.runs[r].target + k);
        }
    }
    for (const auto& s : order.sources) {
        const Run& last = order.runs[s.last_run - 1];
        const Index first = place[s.first_run];
        sources_.push_back({first, place[s.last_run - 1] + last.size - first});
    }
}

void TargetFrame::gather(std::size_t frame, Stretch part, const double* cells, double* places) const {
    const int* target = targets(frame, part);
    for (Index i = 0; i < part.size; ++i) places[i] = cells[target[i]];
}

void TargetFrame::scatter(std::size_t frame, Stretch part, const double* places, double* cells) const {
    const int* target = targets(frame, part);
    for (Index i = 0; i < part.size; ++i) cells[target[i]] = places[i];
}

void TargetFrame::add(std::size_t frame, Stretch part, const double* places, double* cells) const {
    const int* target = targets(frame, part);
    for (Index i = 0; i < part.size; ++i) cells[target[i]] += places[i];
}

}  // namespace forage::engine
