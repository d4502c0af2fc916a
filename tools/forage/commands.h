// What commands of the program share. Each returns the exit status: 0 for success, 1 when the run failed, 2
// for wrong usage or wrong input.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/api/open/prepare.h"

namespace forage::tool {

enum ExitStatus { fine = 0, run_failed = 1, bad_input = 2 };

/// Prints a mistake of the user and a hint. Returns bad_input.
int refused(const std::string& what, const std::string& hint);

struct RunOptions {
    RunOptions() { spec.directory = "forage-out"; }
    RunSpec spec;
    bool real_time = false;  ///< whether the run is slowed down to the clock
    bool quiet = false;
};

/// Parses the options of `forage run`. `arguments` are the words after the program's name.
RunOptions parse_run(std::vector<std::string> arguments);

struct ExperimentOptions {
    std::string file;
    std::string directory;  ///< empty: forage-out/ and the file's name
    std::string system;     ///< a system to check against the file's exercise; empty: run the file's system
    std::vector<std::string> plugins = {};
    int jobs = 0;        ///< number of simultaneous runs; 0: one per core
    bool fresh = false;  ///< whether finished runs are repeated
    bool quiet = false;
    std::vector<std::string> formats = {};  ///< of further tables: "npy", "hdf5"
    std::string bundle = {};                ///< archive for everything that repeats it; none when empty
    std::string shard = {};                 ///< "3/10": executes this part only
    bool merge = false, status = false;
    std::size_t after_round = 0;  ///< with merge: Slurm gets the next round when a later one is planned
    bool slurm = false, dry_run = false;   ///< submits to Slurm, or only writes the scripts
    int tasks = 0;                         ///< of Slurm's array; 0: at most 100
    std::vector<std::string> sbatch = {};  ///< further options of sbatch, such as "--partition=short"
};

/// The words of the command line that decide the results of an experiment.
std::vector<std::string> command_of(const ExperimentOptions& options);

struct StudioCommand {
    RunInput input;
    std::string plot_config;  ///< a layout to open; may be empty
    int port = 0;             ///< 0: a free one
    bool recover = false;     ///< whether to resume the session that was killed
    bool running = false;     ///< whether the run begins at once
    bool open = false;        ///< whether a browser is opened
};

int run(const RunOptions& options);
/// Runs to the end, with a progress line and a summary. Returns the exit status.
int run_to_end(const RunOptions& options, PreparedRun& prepared);
/// Runs every combination of an experiment file with every seed. Runs that were finished before are not
/// repeated.
int experiment(const ExperimentOptions& options);

/// On a terminal, asks whether the plugins of a run in folders that are not trusted may be loaded.
void ask_for_trust(const RunInput& input);

}  // namespace forage::tool
