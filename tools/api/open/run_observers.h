// The observers of a run, made from the parts of its description.
#pragma once

#include "bug_interface/simulation/world.h"
#include "core/run/prepared_run.h"
#include "tools/api/open/sources.h"

namespace forage {

/// Adds the observers that prepared.spec names to the run, which has not started. `world` is null for a run
/// without robots. Reports mistakes in the spec. Throws std::runtime_error when a socket cannot be opened.
void add_observers(PreparedRun& prepared, bug::World* world, Diagnostics& diagnostics);

/// Adds the observer that writes checkpoints, if the spec wants them. The run has started, as the observer
/// notes which files its modules have read.
void add_checkpoints(PreparedRun& prepared, const Sources& sources);

}  // namespace forage
