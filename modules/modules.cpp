#include "modules/modules.h"

#include "modules/replay/replay.h"

namespace forage {

void add_modules(Registry& registry) { registry.add(module_type<replay::Replay>()); }

}  // namespace forage
