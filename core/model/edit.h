// Changes to a system from the command line.
#pragma once

#include <string_view>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// Applies "WHERE.parameter=value". WHERE is a group ("Process/Group": a parameter of its neuron), a process
/// ("Process": a parameter of its module, or enableModule) or a connection (its name or id: a parameter of
/// its synapse). Reports what cannot be done, with the names there are; values are checked like those of a
/// file.
void set(System& system, const Registry& registry, std::string_view assignment, Diagnostics& diagnostics);

}  // namespace forage::model
