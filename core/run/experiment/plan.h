// The runs of an experiment.
#pragma once

#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "core/run/run_spec.h"

namespace forage {

struct PlannedRun {
    std::string name;                 ///< such as "eta-0.1_seed-3"; the name of its directory
    std::vector<std::string> values;  ///< those of the sweeps
    std::string files;                ///< digests of the files of system and world, once they are read
    RunSpec spec;
};

/// The runs of every combination of the swept values with every seed; the last sweep changes fastest.
/// `directory` is that of the experiment, `plugins` are those of all runs.
std::vector<PlannedRun> planned_runs(const model::Experiment& experiment, const std::string& directory,
                                     const std::vector<std::string>& plugins = {});

}  // namespace forage
