// Runs of an experiment, several at a time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/forage/progress.h"
#include "tools/forage/run_result.h"

namespace forage::tool {

/// Reports whatever is wrong with what the file says of its system and world, for every swept value, so that
/// no run fails for it.
void check_experiment(const model::Experiment& experiment, const Sources& sources,
                      std::span<const PlannedRun> runs, Diagnostics& diagnostics);

/// Makes the runs that have no result yet, `jobs` at a time, each on one thread; their results go to their
/// directories as they come. Returns all results in order, or nothing when a signal ended it.
std::optional<std::vector<RunResult>> make_runs(const model::Experiment& experiment, const Sources& sources,
                                                std::span<const PlannedRun> runs, int jobs, bool fresh,
                                                Progress& progress);

}  // namespace forage::tool
