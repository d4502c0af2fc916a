#pragma once

#include "core/types/registry.h"

namespace forage {

/// Adds the modules that read cameras, films and gamepads.
void add_devices(Registry& registry);

}  // namespace forage
