// What a world file says that cannot be meant so, or has no effect here.
#pragma once

#include "bug_interface/world/description.h"
#include "core/model/diagnostic.h"

namespace forage::bug {

/// Looks at the models of a world, each on its own.
void check_models(const WorldDescription& world, Diagnostics& diagnostics);

}  // namespace forage::bug
