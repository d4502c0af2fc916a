// What is left of a run of an experiment: a file that is there when the run is finished, and not before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "core/run/experiment/plan.h"

namespace forage {

struct RunResult {
    std::string failure;   ///< why there are no numbers; empty when there are
    std::string stopped;   ///< why it ended before its time; empty when it did not
    std::string diverged;  ///< where numbers began to be not finite; empty: they are
    std::uint64_t cycles = 0;
    double seconds = 0;                            ///< of the world
    std::optional<std::uint64_t> trials, reached;  ///< of the first robot: finished ones, and at the target
    std::vector<std::optional<double>> measures;   ///< in the experiment's order
};

/// Everything that decides the numbers of a run: a result belongs to a run when it has the same key. `digests`: of the files of
/// system and world.
std::string key_of(const PlannedRun& run, const model::Experiment& experiment, const std::string& digests);

/// The result in a run's directory, if it has one of this key.
std::optional<RunResult> read_result(const PlannedRun& run, const std::string& key);
/// Removes the files that an earlier run left in the directory, its result first.
void forget_result(const PlannedRun& run);
/// Writes it so that it survives whatever happens next: `files`, written before, reach the disk first. Throws
/// std::runtime_error.
void write_result(const PlannedRun& run, const std::string& key, const RunResult& result,
                  const std::vector<std::string>& files);

}  // namespace forage
