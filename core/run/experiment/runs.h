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

/// Creates a run from its description; returns nothing when the diagnostics got an error. Called by one
/// thread at a time.
using PrepareRun = std::function<std::optional<PreparedRun>(const RunSpec&, Diagnostics&)>;

/// Reports all mistakes in what the file says about its systems and world, for every swept value, before the
/// first run.
void check_experiment(const model::Experiment& experiment, const PrepareRun& prepare,
                      std::span<const PlannedRun> runs, Diagnostics& diagnostics);

/// Functions that run_experiment() calls while it works. Each of them may be empty.
struct ExperimentCallbacks {
    /// The argument of `progress`, which is called every 20 ms: the completed fraction of the work, 0..1; the
    /// numbers of finished, failed and all runs; the estimated time left, s, if it is known.
    struct Progress {
        double done = 0;
        std::size_t finished = 0, failed = 0, all = 0;
        std::optional<double> seconds_left;
    };
    std::function<void(const Progress&)> progress = {};
    std::function<bool()> interrupted = {};  ///< called by several threads at the same time
};

/// Executes the runs that have no result yet, `jobs` at a time, each on one thread. Each result is written
/// into its run's directory at once. With `fresh`, finished runs are repeated. Returns all results in order;
/// empty when it was interrupted.
std::optional<std::vector<RunResult>> run_experiment(const model::Experiment& experiment,
                                                     const PrepareRun& prepare,
                                                     std::span<const PlannedRun> runs, int jobs, bool fresh,
                                                     const ExperimentCallbacks& callbacks);

}  // namespace forage
