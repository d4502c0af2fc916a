// Checks a world description for likely mistakes and for elements without effect.
#pragma once

#include <optional>

#include "bug_interface/motion/reset.h"
#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// Checks each model, its plugins and sensors, and the names that have a meaning. Reports errors for robots
/// that cannot be simulated and warnings for everything else.
void check_models(const WorldDescription& world, Diagnostics& diagnostics);

/// Warns about targets and robots outside the bounds, and about models that nothing can touch. `top` is the
/// height of the highest point of the robots and their ray sensors, m.
void check_places(const WorldDescription& world, const std::optional<ResetPlan>& plan, double top,
                  Diagnostics& diagnostics);

}  // namespace forage::bug
