// Checks that a type does what it declares, before a system uses it.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "core/types/neuron.h"
#include "core/types/synapse.h"

namespace forage::plugin {

/// Updates an object of `type` a few times. Returns how the type breaks its declaration, with the numbers;
/// empty when no violation was seen. Other exceptions of an update are left to the run.
///
/// A neuron type must read the inputs and use the states that it declares, write inside its columns, and
/// compute the same numbers whenever it starts. A synapse type must do the latter, too; one that is
/// declared event driven must be so for all numbers. Parameters may be anywhere in their ranges.
std::string contract_violation(const NeuronType& type);
std::string contract_violation(const SynapseType& type);

/// Whether two trials gave the same numbers, bit by bit.
inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
/// The violation of a type that gives other numbers when it starts again.
inline std::string another_each_time(const std::string& instead) {
    return "it computes other numbers when it starts again with the same input: it uses rand(), the clock, "
           "or "
           "a "
           "variable that is shared by all objects; " +
           instead;
}

}  // namespace forage::plugin
