// The module types that ship with Forage.
#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds moduleAL, moduleCL, moduleColor, differenceModule and directionModule to `registry`.
void add_modules(Registry& registry);

}  // namespace forage
