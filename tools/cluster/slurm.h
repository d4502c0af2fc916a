// Experiments on Slurm: the scripts of an array of parts and of the merge behind them, and their submission.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::cluster {

struct SlurmJob {
    std::string file, directory;           ///< the experiment, and that of its results
    std::vector<std::string> plugins;      ///< as for `forage experiment`
    std::vector<std::string> sbatch = {};  ///< options of sbatch, such as "--partition=short"
    int tasks = 0;                         ///< number of parts; 0: 100, or that of the runs if it is smaller
    std::size_t round = 0;  ///< of an experiment that adapts itself: its merge submits what follows
};

/// Writes DIRECTORY/slurm/parts.sh and merge.sh, and submits them, unless it is a dry run. Returns what to
/// tell the user. Reports an error when sbatch fails.
std::string submit(const SlurmJob& job, std::size_t runs, bool dry_run, Diagnostics& diagnostics);

/// Submits the scripts in DIRECTORY/slurm again, for another round. Returns what to tell the user.
std::string submit_round(const std::string& directory, std::size_t round, Diagnostics& diagnostics);

/// The lines of DIRECTORY/slurm/jobs, one per submission.
std::vector<std::string> submitted_jobs(const std::string& directory);

}  // namespace forage::cluster
