// Checks that a type does what it declares, before a system uses it.
#pragma once

#include <string>

#include "core/types/neuron.h"
#include "core/types/synapse.h"

namespace forage::plugin {

/// Updates an object of `type` a few times. Returns how the type breaks its declaration, with the numbers;
/// empty when no violation was seen. Other exceptions of an update are left to the run.
///
/// A neuron type must read the inputs and use the states that it declares, write inside its columns, and
/// compute the same numbers whenever it starts anew. A synapse type that is declared event driven must be so
/// for all numbers, and for parameters anywhere in their ranges.
std::string contract_violation(const NeuronType& type);
std::string contract_violation(const SynapseType& type);

}  // namespace forage::plugin
