// Systems of random connections, for benchmarks.
#pragma once

#include <string>

#include "core/model/build.h"

namespace forage::bench {

/// A system of `cells` random spikes (probability 0.3) and as many linear threshold cells, or `targets` of
/// them. Each of these has synapses of different strengths from `each` random source cells.
inline model::System random_lists(int cells, int each, int targets = 0) {
    model::System system;
    const auto process = model::add_process(system, "P");
    const auto from = model::add_group(system, process, "From", cells, 1, "neuronRandomSpike");
    const auto to =
        model::add_group(system, process, "To", targets > 0 ? targets : cells, 1, "neuronLinearThreshold");
    model::set_parameter(model::find_group(system, from)->neuron, "probability", "0.3");
    const auto id = model::add_connection(system, from, to, InputKind::excitatory, "synapseFixedWeight");
    auto& connection = *model::find_connection(system, id);
    connection.arborization.shape = model::RandomArbor{each};
    connection.attenuation.form = model::RandomFunction{};
    return system;
}

}  // namespace forage::bench
