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
void check_experiment(const model::Experiment& experiment, const PrepareRun& prepare, const RunPlan& plan,
                      Diagnostics& diagnostics);

/// Functions that run_experiment() calls while it works. Each of them may be empty.
struct ExperimentCallbacks {
    /// The argument of `progress`, which is called every 20 ms: the completed fraction of the work, 0..1; the
    /// numbers of finished, failed and all runs; the estimated time left, s, if it is known; the round of an
    /// experiment that adapts itself, else 0. Work and runs are those of the rounds so far.
    struct Progress {
        double done = 0;
        std::size_t finished = 0, failed = 0, all = 0;
        std::optional<double> seconds_left;
        std::size_t round = 0;
    };
    std::function<void(const Progress&)> progress = {};
    std::function<bool()> interrupted = {};  ///< called by several threads at the same time
};

/// Runs that are executed together.
struct RunBlock {
    const model::Experiment& experiment;
    const PrepareRun& prepare;
    const RunPlan& plan;
    std::vector<std::size_t> open;  ///< the runs, in this order
    std::size_t earlier = 0;        ///< how many others have results, for progress
    bool files = true;              ///< whether each run leaves files in its directory, also its result
    std::size_t round = 0;          ///< for progress
};
/// Takes a result, and the run's trials.csv, as soon as there is one; called by one thread at a time.
using KeepResult = std::function<void(std::size_t run, RunResult&&, const std::string& trials)>;

/// Executes runs, `jobs` at a time, each on one thread. Returns whether all were executed; the others were
/// interrupted. Throws what `keep` throws.
bool execute_runs(const RunBlock& block, int jobs, const KeepResult& keep,
                  const ExperimentCallbacks& callbacks);

}  // namespace forage
