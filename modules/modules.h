#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds the module types that ship with Forage and need nothing from outside.
void add_modules(Registry& registry);

}  // namespace forage
