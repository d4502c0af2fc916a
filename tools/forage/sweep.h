// The runs of an experiment.
#pragma once

#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "tools/forage/commands.h"

namespace forage::tool {

struct PlannedRun {
    std::string name;                 ///< "eta-0.1_seed-3": its directory
    std::vector<std::string> values;  ///< of the swept parameters
    std::uint64_t seed = 1;
    RunOptions options;
};

/// Every combination of the swept values, the last parameter changing fastest, with every seed. `directory`
/// is the experiment's.
std::vector<PlannedRun> planned_runs(const model::Experiment& experiment, const std::string& directory);

}  // namespace forage::tool
