// Experiment files: read, checked, run, and written as tables.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/output_files.h"
#include "core/observe/table_file.h"
#include "core/run/experiment/exercise.h"
#include "core/run/experiment/parts.h"
#include "core/run/experiment/runs.h"
#include "core/run/result_names.h"
#include "tools/api/open/sources.h"

namespace forage {

/// An experiment that is checked, with its directory made and locked. If it adapts itself, its runs are those
/// of the rounds that are known, and functions that read or execute results add rounds.
struct PreparedExperiment {
    model::Experiment experiment;
    std::string directory;
    RunPlan runs;
    std::size_t round = 1;
    std::map<std::string, Sources> sources;  ///< by the path of the first system of the runs
    DirectoryHold hold;
    std::vector<observe::TableFormat> formats = {};  ///< in which results.csv is written, too

    std::optional<PreparedRun> prepare(const RunSpec& spec, Diagnostics& diagnostics) const;

    std::string results_file() const { return directory + "/results.csv"; }
    std::string summary_file() const { return directory + "/summary.csv"; }
    std::string trials_file() const { return directory + "/" + forage::trials_file(); }
    /// Whether its runs leave files besides their numbers, when parts execute them.
    bool parts_leave_files() const { return !experiment.recordings.empty() || !experiment.plots.empty(); }
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
/// Prepares a part of an experiment, or to read what parts have left: makes the directory, but locks nothing,
/// because other parts work in it at the same time.
std::optional<PreparedExperiment> prepare_part(model::Experiment experiment, std::string directory,
                                               const std::vector<std::string>& plugins,
                                               Diagnostics& diagnostics);
/// Does the same with an experiment file.
std::optional<PreparedExperiment> prepare_part(const std::string& file, std::string directory,
                                               const std::vector<std::string>& plugins,
                                               Diagnostics& diagnostics);

/// Executes the runs that are not finished yet (with `fresh`, all of them), `jobs` at a time (0: one per
/// core), and writes the tables of results. Returns the results in the order of the runs; empty when it was
/// interrupted.
std::optional<std::vector<RunResult>> run_experiment(PreparedExperiment& experiment, int jobs, bool fresh,
                                                     const ExperimentCallbacks& callbacks);

/// The results that the runs have: those of parts, and those in the directories of runs. The runs become
/// those of all rounds that these results decide.
PartResults read_results(PreparedExperiment& experiment, const std::optional<Shard>& only = {});

/// How a part of an experiment ended.
struct PartOutcome {
    bool finished = false;  ///< whether all its runs were executed; otherwise it was interrupted
    std::size_t runs = 0;   ///< how many were executed now
    std::vector<std::pair<std::string, std::string>> failures = {};  ///< names of runs, and reasons
};
/// Executes the runs `wanted`, and adds their results to `file`. Throws std::runtime_error when it cannot be
/// written.
PartOutcome run_part(const PreparedExperiment& experiment, PartFile& file, std::vector<std::size_t> wanted,
                     int jobs, const ExperimentCallbacks& callbacks);
/// Executes the runs of one part that have no numbers yet; with `fresh`, all of them. Of an experiment that
/// adapts itself, these are runs of the rounds that are known when the part begins.
PartOutcome run_part(PreparedExperiment& experiment, const Shard& shard, int jobs, bool fresh,
                     const ExperimentCallbacks& callbacks);
/// The runs without numbers.
std::vector<std::size_t> open_runs(const PartResults& results);

/// Writes the tables of an experiment whose parts have results of all runs, byte for byte those of
/// run_experiment(), and returns the results. When runs have no result, reports an error, writes nothing and
/// returns nothing.
std::optional<std::vector<RunResult>> merge(PreparedExperiment& experiment, Diagnostics& diagnostics);

/// The digests of all files that the experiment in `file` has read, for a bundle.
InputFiles input_files(const std::string& file, const PreparedExperiment& experiment);

/// The names of the files that the runs and tables have left in the directory, without those of parts.
std::vector<std::string> result_files(const PreparedExperiment& experiment);

/// What became of the requirements of the file's exercise, in order; `results` are those of all runs.
std::vector<Finding> findings(const PreparedExperiment& experiment, std::span<const RunResult> results,
                              Diagnostics& diagnostics);

}  // namespace forage
