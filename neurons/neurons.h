#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds the neuron types that ship with Forage.
void add_neurons(Registry& registry);

}  // namespace forage
