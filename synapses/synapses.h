#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds the synapse types that ship with Forage.
void add_synapses(Registry& registry);

}  // namespace forage
