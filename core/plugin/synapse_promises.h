// What a synapse type says of itself, tried out.
#pragma once

#include <string>

#include "core/types/synapse.h"

namespace forage::plugin {

/// Tries event_driven(), output() and update_and_add() with many numbers, and with parameters anywhere
/// in their ranges. Returns what the type does against its word, with the numbers; empty when nothing was
/// seen, or when an update throws.
std::string broken_promise(const SynapseType& type);

}  // namespace forage::plugin
