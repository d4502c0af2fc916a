// Updates of a type on a stage of its own, before it gets near a system.
#pragma once

#include <string>

#include "core/types/neuron.h"
#include "core/types/synapse.h"

namespace forage::plugin {

/// Runs some updates of an object of `type` with inputs of 0. Returns what the type does against its
/// declaration: uses states that it has not, or writes beside its columns; empty when nothing. Other
/// exceptions are no concern of this: they belong to the run.
std::string rehearse(const NeuronType& type);
std::string rehearse(const SynapseType& type);

}  // namespace forage::plugin
