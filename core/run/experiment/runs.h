// Runs of an experiment, several at a time.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run/experiment/plan.h"
#include "core/run/experiment/result.h"
#include "core/run/prepared_run.h"

namespace forage {

/// Makes a run of its description; empty when the diagnostics got an error. Called by one thread at a time.
using PrepareRun = std::function<std::optional<PreparedRun>(const RunSpec&, Diagnostics&)>;

/// Reports whatever is wrong with what the file says of its system and world, for every swept value, so that no run fails for it.
void check_experiment(const model::Experiment& experiment, const PrepareRun& prepare, std::span<const PlannedRun> runs,
                      Diagnostics& diagnostics);

/// What callers of run_experiment() may do meanwhile. All may be empty.
struct ExperimentCallbacks {
    /// Called every 20 ms: the share of the work that is done, 0..1; runs done, failed and in all; seconds that are left, if
    /// that can be told.
    struct Progress {
        double done = 0;
        std::size_t finished = 0, failed = 0, all = 0;
        std::optional<double> seconds_left;
    };
    std::function<void(const Progress&)> progress = {};
    std::function<bool()> interrupted = {};  ///< called by several threads at a time
};

/// Makes the runs that have no result yet, `jobs` at a time, each on one thread; results go to the runs' directories as they
/// come. `digests`: of the files that decide all runs. `fresh`: repeat finished runs. Returns all results in order, or nothing
/// when it was interrupted.
std::optional<std::vector<RunResult>> run_experiment(const model::Experiment& experiment, const PrepareRun& prepare,
                                                     std::span<const PlannedRun> runs, const std::string& digests,
                                                     int jobs, bool fresh, const ExperimentCallbacks& callbacks);

}  // namespace forage
