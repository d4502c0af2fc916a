// A run that is ready to start, and how it is brought to its end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/output_files.h"
#include "core/run/checkpoint_writer.h"
#include "core/run/result_files.h"
#include "core/run/run.h"
#include "core/run/run_measures.h"
#include "core/run/run_spec.h"
#include "core/run/stop_condition.h"
#include "core/observe/schedule.h"

namespace forage {

/// A run made of a RunSpec, with all observers that it asks for.
struct PreparedRun {
    RunSpec spec;
    DirectoryHold hold;  ///< of the directory of results, if there is one
    Run run;
    StopCondition stop;
    const observe::Schedule* schedule;  ///< an observer of the run, like those below
    RunMeasures* measures;
    CheckpointWriter* checkpoints;  ///< null without
    std::vector<std::string> plugins;                             ///< the files of those that were loaded
    std::vector<std::pair<std::string, std::string>> libraries;  ///< names and versions, for run.json
};

/// How a run went.
struct RunOutcome {
    std::uint64_t first_cycle = 0;       ///< in which it went on; 0 for a run from the start
    std::string stopped;                 ///< why it ended before its length was reached; empty when it did not
    std::string state;                   ///< a digest at the end; empty when none is wanted
    std::vector<std::string> problems;   ///< what failed; empty when nothing did
    ResultFiles files{{}};               ///< what was written
    double clock_seconds = 0;            ///< of the cycles
};

/// What users of run_to_end() may do meanwhile. All may be empty.
struct RunCallbacks {
    std::function<void()> after_cycle = {};            ///< progress, pace
    std::function<std::string()> interrupted = {};     ///< why to stop now; empty: go on
    std::function<void(const std::string&)> diverged = {};  ///< called once, when a number is not finite any more
};

/// Runs until the stop condition holds or something stops the run, and writes what it leaves behind into spec.directory: the
/// observers' files, and run.json. A failure does not keep the rest from being written.
RunOutcome run_to_end(PreparedRun& prepared, const RunCallbacks& callbacks = {});

/// The file run.json: versions, seed and settings that are needed to repeat the run, and what came of it. No times and no
/// dates: the same run gives the same text.
std::string run_json(const PreparedRun& prepared, const RunOutcome& outcome);
/// What decides a run, as names and texts, for recordings.
std::vector<std::pair<std::string, std::string>> run_attributes(
    const RunSpec& spec, const Run& run, const std::vector<std::string>& plugins,
    const std::vector<std::pair<std::string, std::string>>& libraries);
/// The files that the run before left in a directory, by its run.json; empty when it cannot be read.
std::vector<std::string> files_of_last_run(const std::string& directory);
/// What pictures of a run are called: "dac.iqr in arena.world, seed 1".
std::string run_title(const RunInput& input);

}  // namespace forage
