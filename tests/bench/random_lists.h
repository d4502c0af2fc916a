// Systems of random connections, for benchmarks.
#pragma once

#include <string>

#include "core/model/build.h"

namespace forage::bench {

/// `cells` random spikes (probability 0.3) to as many linear threshold cells, each of which has synapses from
/// `each` random source cells, all of different strength.
inline model::System random_lists(int cells, int each) {
    model::System system;
    const auto process = model::add_process(system, "P");
    const auto from = model::add_group(system, process, "From", cells, 1, "neuronRandomSpike");
    const auto to = model::add_group(system, process, "To", cells, 1, "neuronLinearThreshold");
    model::set_parameter(model::find_group(system, from)->neuron, "probability", "0.3");
    const auto id = model::add_connection(system, from, to, InputKind::excitatory, "synapseFixedWeight");
    auto& connection = *model::find_connection(system, id);
    connection.arborization.shape = model::RandomArbor{each};
    connection.attenuation.form = model::RandomFunction{};
    return system;
}

}  // namespace forage::bench
