// From what a file says of a connection to its list of synapses: a pure function.
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/system.h"

namespace forage::connectivity {

/// The synapses of a connection, in the order in which a target's inputs are summed. Arrays of equal length.
struct Synapses {
    std::vector<int> pre, post;    ///< cell indices in source and target
    std::vector<double> distance;  ///< in cells
    std::vector<int> delay;        ///< in cycles
    std::vector<double> attenuation;
    double reference = 1;  ///< a synapse passes psp * (reference - attenuation)

    std::size_t size() const { return pre.size(); }
};

/// The largest connection that is built: 2.8 GB while it is (measured: 2.74 GB), then 0.4 to 2 GB of it.
inline constexpr double most_synapses = 1e8;

/// Builds the synapses of `connection` between groups of these topologies. `seed` decides everything random.
/// Reports a connection without synapses, one that could have more than `most`, and what else its pattern
/// cannot mean.
Synapses connect(const model::Connection& connection, const model::Topology& source,
                 const model::Topology& target, std::uint64_t seed, Diagnostics& diagnostics,
                 double most = most_synapses);

}  // namespace forage::connectivity
