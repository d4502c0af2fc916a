// Checks that a type does what it declares, before it gets near a system.
#pragma once

#include <string>

#include "core/types/neuron.h"
#include "core/types/synapse.h"

namespace forage::plugin {

/// Updates an object of `type` a few times. Returns what the type does against its declaration, with the
/// numbers; empty when nothing was seen. Other exceptions of an update are left to the run.
///
/// A neuron type without a Cell must use the states that it declares, and write inside of its columns. A
/// synapse type that is event driven must be so with all numbers and with parameters anywhere in their
/// ranges.
std::string contract_violation(const NeuronType& type);
std::string contract_violation(const SynapseType& type);

}  // namespace forage::plugin
