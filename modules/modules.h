// The module types that ship with Forage.
#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds every module type of this folder except moduleReplay, which only tests use, to `registry`.
void add_modules(Registry& registry);

}  // namespace forage
