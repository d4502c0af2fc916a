// Builds the list of synapses of a connection: a pure function.
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/system.h"

namespace forage::connectivity {

/// The synapses of a connection, in the order in which the inputs of a target are summed. All arrays have the
/// same length.
struct Synapses {
    std::vector<int> pre, post;    ///< cell indices in source and target
    std::vector<double> distance;  ///< in cells
    std::vector<int> delay;        ///< in cycles
    std::vector<double> attenuation;
    std::vector<double> weight;  ///< of model::Weights; empty for other patterns
    double reference = 1;        ///< a synapse passes psp * (reference - attenuation)

    std::size_t size() const { return pre.size(); }
};

/// The largest number of synapses that is accepted. So many synapses take up to 2.8 GB (measured: 2.74 GB)
/// while they are built, and 0.4 to 2 GB afterwards.
inline constexpr std::size_t max_synapses = 100'000'000;

/// Builds the synapses of `connection` between groups of these topologies. `seed` decides everything random.
/// Reports a connection without synapses, a connection that has more than `max`, and mistakes in its
/// pattern.
Synapses connect(const model::Connection& connection, const model::Topology& source,
                 const model::Topology& target, std::uint64_t seed, Diagnostics& diagnostics,
                 std::size_t max = max_synapses);

}  // namespace forage::connectivity
