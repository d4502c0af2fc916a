// Connections that are the same everywhere, known without a list of their synapses.
#pragma once

#include <optional>
#include <vector>

#include "core/model/system.h"

namespace forage::connectivity {

/// What each target cell receives from. The synapses are those that connect() would list, and in its order.
struct Regular {
    /// A synapse of every target cell at (x, y), from source cell (x + dx, y + dy), where there is one.
    struct Tap {
        int dx, dy;
        double attenuation;
        int delay;
    };
    bool all_to_all = false;    ///< every source cell, in order, as the only tap says
    int width = 0, height = 0;  ///< of source and target, unless it is all to all
    std::vector<Tap> taps;      ///< in the order in which they are summed
    double reference = 1;       ///< a synapse passes psp * (reference - attenuation)
    std::size_t synapses = 0;
};

/// Finds rectangular windows between groups of one size, and all to all; nothing when the connection is
/// something else, is random, wraps, or is none at all.
std::optional<Regular> regular(const model::Connection& connection, const model::Topology& source,
                               const model::Topology& target);

}  // namespace forage::connectivity
