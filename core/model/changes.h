// What an edit means for a system that runs.
#pragma once

#include <optional>
#include <vector>

#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// The parameters that differ between two systems, with their values in `after`: all that a run needs to
/// become one of `after`. Names, notes, places and colours that a run does not know do not count. Values that
/// are not valid are left out. Empty when something else differs, so the run must be rebuilt. The
/// result refers to `registry`; names of files in it are relative to the file of `after`.
std::optional<std::vector<Assignment>> parameter_changes(const System& before, const System& after,
                                                         const Registry& registry);

}  // namespace forage::model
