// run.json: the input and the results of a run, as a file beside its other results.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/run/prepared_run.h"

namespace forage {

/// The content of run.json: versions, seed and settings that are needed to repeat the run, and its results.
/// It has no times or dates, so the same run gives the same text.
std::string run_json(const PreparedRun& prepared, const RunOutcome& outcome);

/// Everything that decides a run, as pairs of name and text, for the attributes of recordings.
std::vector<std::pair<std::string, std::string>> run_attributes(
    const RunSpec& spec, const Run& run, const std::vector<std::string>& plugins,
    const std::vector<std::pair<std::string, std::string>>& libraries);

/// The content of run.json about a run that has ended.
struct FinishedRun {
    RunInput input;                                  ///< system, world, seed, settings and leniency
    std::vector<std::string> command;                ///< the words after "forage" that decide its results
    InputFiles inputs;                               ///< digests of all files that it has read
    double seconds_per_cycle = 0;                    ///< duration of a cycle, s; 0 when it is not known
    std::vector<std::string> files;                  ///< names of the files beside run.json
    std::vector<ResultFiles::Recording> recordings;  ///< the sources that files hold
    std::vector<std::pair<std::string, std::string>>
        settings;  ///< the settings of the run, in the order of the file
};

/// Reads run.json in a directory of results. Empty when there is none, or when a run has not written it.
std::optional<FinishedRun> read_run_json(const std::string& directory);

}  // namespace forage
