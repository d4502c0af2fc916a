// The module types that ship with Forage.
#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds the module types that need nothing but their groups. (moduleReplay comes with its table, the robot's
/// with its world.)
void add_modules(Registry& registry);

}  // namespace forage
