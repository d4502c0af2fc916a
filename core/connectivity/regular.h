// Connections in which every target cell has the same neighbourhood of source cells. They need no list of
// synapses.
#pragma once

#include <optional>
#include <vector>

#include "core/model/system.h"

namespace forage::connectivity {

/// The source cells of each target cell. The synapses and their order are those that connect() would list.
struct Regular {
    /// A synapse to every target cell (x, y) from source cell (x + dx, y + dy), if that exists.
    struct Tap {
        int dx, dy;
        double attenuation;
        int delay;
        bool operator==(const Tap&) const = default;
    };
    /// Every cell of `sources` is connected with every cell of `targets`, in this order, with the values of
    /// the only tap.
    bool all_to_all = false;
    std::vector<int> sources, targets;  ///< cells; unused if all_to_all is not set
    int width = 0, height = 0;          ///< size of source and target, cells; unused if all_to_all is set
    std::vector<Tap> taps;              ///< in the order in which they are summed
    double reference = 1;               ///< a synapse passes psp * (reference - attenuation)
    std::size_t synapses = 0;
};

/// Whether random numbers decide the synapses of a connection, their attenuations or their delays.
bool is_drawn(const model::Connection& connection);

/// Recognises rectangular windows between groups of the same size, and a PatternForeach that pairs each cell
/// once. Empty for other connections, for those that are random or have no synapses, for windows that wrap
/// around, and if there is something to report about the pattern.
std::optional<Regular> regular(const model::Connection& connection, const model::Topology& source,
                               const model::Topology& target);

}  // namespace forage::connectivity
