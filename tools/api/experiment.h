// Experiment files: read, checked, run, and written as tables.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/output_files.h"
#include "core/run/experiment/exercise.h"
#include "core/run/experiment/runs.h"
#include "tools/api/sources.h"

namespace forage {

/// An experiment that is checked, with its directory made and locked.
struct PreparedExperiment {
    model::Experiment experiment;
    std::string directory;
    std::vector<PlannedRun> runs;
    std::map<std::string, Sources> sources;  ///< by the path of the first system of the runs
    DirectoryHold hold;

    std::optional<PreparedRun> prepare(const RunSpec& spec, Diagnostics& diagnostics) const;

    std::string results_file() const { return directory + "/results.csv"; }
    std::string summary_file() const { return directory + "/summary.csv"; }
};

/// Plans the runs of an experiment, reads their files and checks everything that the experiment says about
/// them, without writing anything. With `exercise`, it is with_system()'s. Empty when `diagnostics` got an
/// error.
std::optional<PreparedExperiment> plan_experiment(model::Experiment experiment, std::string directory,
                                                  const std::vector<std::string>& plugins,
                                                  Diagnostics& diagnostics, bool exercise = false);
/// Does the same, and makes and locks the directory.
std::optional<PreparedExperiment> prepare_experiment(model::Experiment experiment, std::string directory,
                                                     const std::vector<std::string>& plugins,
                                                     Diagnostics& diagnostics, bool exercise = false);

/// Reads an experiment file and checks all its runs. An empty `directory` stands for forage-out/ and the
/// file's name. Reports all mistakes before anything is run or overwritten; empty when `diagnostics` got an
/// error. With a path in `system`, the file's exercise is prepared with this system instead of the file's.
std::optional<PreparedExperiment> prepare_experiment(const std::string& file, std::string directory,
                                                     const std::vector<std::string>& plugins,
                                                     Diagnostics& diagnostics,
                                                     const std::string& system = {});

/// Executes the runs that are not finished yet (with `fresh`, all of them), `jobs` at a time (0: one per
/// core), and writes the tables of results. Returns the results in the order of the runs; empty when it was
/// interrupted.
std::optional<std::vector<RunResult>> run_experiment(const PreparedExperiment& experiment, int jobs,
                                                     bool fresh, const ExperimentCallbacks& callbacks);

/// What became of the requirements of the file's exercise, in order; `results` are those of all runs.
std::vector<Finding> findings(const PreparedExperiment& experiment, std::span<const RunResult> results,
                              Diagnostics& diagnostics);

}  // namespace forage
