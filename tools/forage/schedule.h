// Changes of parameters over a run, as users write them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/observe/schedule.h"
#include "tools/forage/load.h"

namespace forage::tool {

/// A text "WHEN: WHERE.parameter=value" of the command line; empty when it is not one. WHEN ends at the first
/// colon that a blank follows, outside of double quotes.
std::optional<model::ScheduledChange> parse_timed(std::string_view text);

/// Changes of parameters of a system. Reports what cannot be, apart from what Simulation::check() finds.
observe::Schedule schedule(const std::vector<model::ScheduledChange>& wishes, const Loaded& loaded,
                           const engine::Layout& layout, Diagnostics& diagnostics);

/// Whether conditions may speak of trials.
bool has_trials(const Loaded& loaded);

}  // namespace forage::tool
