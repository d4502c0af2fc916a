// What a run leaves behind.
#pragma once

#include <string>
#include <vector>

#include "tools/forage/commands.h"
#include "tools/forage/recordings.h"
#include "tools/forage/trials.h"

namespace forage::tool {

/// How a run went.
struct Outcome {
    std::optional<std::uint64_t> length;  ///< cycles that were asked for; empty when trials end the run
    std::uint64_t cycles = 0;
    std::uint64_t first_cycle = 0;    ///< in which it went on, 0 for a run from the start
    double seconds = 0;               ///< of the world
    double clock = 0;                 ///< s of the clock
    std::uint64_t shared_cycles = 0;  ///< by several threads
    std::vector<std::pair<std::string, std::optional<std::uint64_t>>>
        changes;             ///< of --at, and the first cycle in which each acted; empty: it never did
    std::string diverged;    ///< where numbers began to be not finite; empty: they are
    std::string stopped;     ///< why it ended before its time; empty when it did not
    std::string state;       ///< a digest of it at the end; empty when it is not wanted
    bool resumable = false;  ///< there is a checkpoint to go on from
    std::size_t frames = 0;  ///< of the film
    int groups = 0;          ///< of the system
    std::vector<std::string> pruned;  ///< those of them that nothing reads
    std::vector<std::string> files;
    std::vector<Recordings::Entry> recordings;
    std::vector<Trials> trials;  ///< of each robot of the world
};

/// Versions, seed and settings: what is needed to repeat the run, and what came of it. No times and no dates:
/// the same run gives the same text.
std::string run_json(const RunOptions& options, const Loaded& loaded, const Outcome& outcome);

/// What decides the run, as names and texts: what a recording says of where it comes from.
std::vector<std::pair<std::string, std::string>> run_attributes(const RunOptions& options,
                                                                const Loaded& loaded);

/// The files that the run before left in a directory, by its run.json; empty when there is none to be read.
std::vector<std::string> files_of_last_run(const std::string& directory);

/// What a picture of the run is called.
std::string picture_title(const RunOptions& options, const Loaded& loaded);

/// For people.
std::string summary(const RunOptions& options, const Loaded& loaded, const Outcome& outcome);

}  // namespace forage::tool
