// What a world file says that cannot be meant so, or has no effect here.
#pragma once

#include <optional>

#include "bug_interface/motion/reset.h"
#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// Looks at the models of a world, each on its own, and at the names that mean something.
void check_models(const WorldDescription& world, Diagnostics& diagnostics);

/// What nobody can reach or touch: targets and robots outside of the bounds, what hangs above everything.
/// `top`: of the robots and their ray sensors, m.
void check_places(const WorldDescription& world, const std::optional<ResetPlan>& plan, double top,
                  Diagnostics& diagnostics);

}  // namespace forage::bug
