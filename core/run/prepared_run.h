// A run that is ready to start, and the function that runs it to its end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/output_files.h"
#include "core/observe/group_statistics.h"
#include "core/observe/schedule.h"
#include "core/run/checkpoint_writer.h"
#include "core/run/remote_control.h"
#include "core/run/result_files.h"
#include "core/run/run.h"
#include "core/run/run_measures.h"
#include "core/run/run_spec.h"
#include "core/run/stop_condition.h"

namespace forage {

/// A run that was created from a RunSpec, with all its observers.
struct PreparedRun {
    RunSpec spec;
    DirectoryHold hold = {};  ///< the lock of the directory of results, if there is one
    Run run;
    StopCondition stop;
    const observe::Schedule* schedule = nullptr;  ///< an observer of the run, like the next two
    RunMeasures* measures = nullptr;
    CheckpointWriter* checkpoints = nullptr;               ///< null in a run without checkpoints
    RemoteControl* remote = nullptr;                       ///< null in a run without remote control
    const observe::GroupStatistics* statistics = nullptr;  ///< null unless the spec asks for an explanation
    /// Returns sentences on what drove the robots, after the run; empty like `statistics`.
    std::function<std::vector<std::string>()> motor_report = [] { return std::vector<std::string>(); };
    std::vector<std::string> plugins = {};  ///< paths of the loaded files
    InputFiles inputs = {};                 ///< what a run of the command line has read
    FileTexts module_texts = {};            ///< for a bundle: files of modules, which may write them
    /// Names and versions of libraries, for run.json.
    std::vector<std::pair<std::string, std::string>> libraries = {};
};

/// The outcome of a run.
struct RunOutcome {
    std::uint64_t first_cycle = 0;      ///< the cycle in which a resumed run continued; 0 for others
    std::string stopped;                ///< the reason for an early end; empty when there was none
    std::string state;                  ///< the digest of the final state; empty without --hash
    std::vector<std::string> problems;  ///< failures; empty when there were none
    ResultFiles files{{}};              ///< the written files
    double clock_seconds = 0;           ///< wall-clock time of the cycles
};

/// Functions that run_to_end() calls while it works. Each of them may be empty.
struct RunCallbacks {
    std::function<void()> after_cycle = {};         ///< called after each cycle, for progress and pace
    std::function<std::string()> interrupted = {};  ///< returns the reason to stop now; empty to continue
    /// Called once, after a few seconds, when the rest of the run will take more than an hour at this rate:
    /// the time that is left, s.
    std::function<void(double)> takes_long = {};
    /// Called with a line about each command of remote control.
    std::function<void(const std::string&)> commanded = {};
    /// Called once, with the first number that is not finite.
    std::function<void(const std::string&)> diverged = {};
};

/// Opens the files of a run that is not resumed. Throws std::runtime_error when a file cannot be opened, and
/// when a folder or a device has the name of a file that the run will write.
void begin_files(PreparedRun& prepared);

/// Runs until the stop condition holds, a command of remote control ends it, or something stops the run. Then
/// writes the observers' files and run.json into spec.directory. When one file fails, the others are still
/// written.
RunOutcome run_to_end(PreparedRun& prepared, const RunCallbacks& callbacks = {});

/// The title of a run's pictures, such as "dac.iqr in arena.world, seed 1".
std::string run_title(const RunInput& input);

}  // namespace forage
