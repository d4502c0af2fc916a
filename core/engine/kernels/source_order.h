// Plastic synapses by their source: in which order, and onto which targets.
#pragma once

#include <vector>

#include "core/base/column.h"
#include "core/connectivity/connect.h"

namespace forage::engine {

/// Target cells that follow each other.
struct Run {
    int target, size;
    friend bool operator==(const Run&, const Run&) = default;
};

/// The sources of a connection in an order in which every target can sum its synapses in synapse order: one
/// source after the other. Sources that follow each other share a frame where they can: runs of target cells,
/// of which each has a part that hangs together. The sources of a column, for instance, whose windows
/// overlap.
struct SourceOrder {
    struct Source {
        int cell;
        std::size_t frame;
        std::size_t first_run, last_run;  ///< in `runs`; last: one past
    };
    struct Frame {
        std::size_t first_source, last_source, first_run, last_run;
    };
    std::vector<Source> sources;  ///< those that have synapses
    std::vector<Frame> frames;
    std::vector<Run> runs;  ///< of one frame after the other; in ascending order of targets in each
};

/// Without sources when there is no such order, when there are delays, or when the sources have too few
/// synapses each for an update of their own (below 8 on average).
SourceOrder order_of_sources(const connectivity::Synapses& synapses, int source_cells, int target_cells);

}  // namespace forage::engine
