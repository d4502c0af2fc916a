// The runs of an experiment.
#pragma once

#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "core/run/run_spec.h"

namespace forage {

struct PlannedRun {
    std::string name;                 ///< "eta-0.1_seed-3": its directory
    std::vector<std::string> values;  ///< of the swept parameters
    RunSpec spec;
};

/// Every combination of the swept values, the last parameter changing fastest, with every seed. `directory` is the experiment's,
/// `plugins` are those of all runs.
std::vector<PlannedRun> planned_runs(const model::Experiment& experiment, const std::string& directory,
                                     const std::vector<std::string>& plugins = {});

}  // namespace forage
