// Changes of parameters over a run, as a person writes them.
#pragma once

#include <string>
#include <vector>

#include "core/observe/schedule.h"
#include "tools/forage/load.h"

namespace forage::tool {

/// What --at asks for: texts "WHEN: WHERE.parameter=value". Reports what cannot be.
observe::Schedule schedule(const std::vector<std::string>& wishes, const Loaded& loaded,
                           const engine::Simulation& simulation, Diagnostics& diagnostics);

/// Whether conditions may speak of trials.
bool has_trials(const Loaded& loaded);

/// The moment before the next cycle.
observe::Moment moment(const Loaded& loaded, const engine::Simulation& simulation, double seconds_per_cycle);

}  // namespace forage::tool
