// The result of a run of an experiment: a file that exists only when the run is finished.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/experiment.h"
#include "core/run/experiment/plan.h"

namespace forage {

struct RunResult {
    std::string failure;   ///< the reason why there are no numbers; empty when there are some
    std::string stopped;   ///< the reason for an early end; empty when there was none
    std::string diverged;  ///< where the first number that is not finite occurred; empty when all are finite
    std::vector<std::pair<std::string, std::string>> warnings = {};  ///< texts and hints
    std::string until;               ///< the condition that ended it before its length; empty when none did
    std::vector<std::string> never;  ///< the conditions of changes that never happened
    std::uint64_t cycles = 0;
    double seconds = 0;                            ///< seconds of the world
    std::optional<std::uint64_t> trials, reached;  ///< the first robot's finished trials; those at the target
    std::vector<std::optional<double>> measures;   ///< in the experiment's order
};

/// A text that holds everything that decides the numbers of a run. A result belongs to a run when it has the
/// same key.
std::string key_of(const PlannedRun& run, const model::Experiment& experiment);

/// The result in a run's directory; empty when there is none with this key.
std::optional<RunResult> read_result(const PlannedRun& run, const std::string& key);
/// Removes the files that an earlier run left in the directory, its result first.
void forget_result(const PlannedRun& run);
/// Writes the result, as a whole or not at all. `files`, which were written before, are flushed to the disk
/// first. Throws std::runtime_error.
void write_result(const PlannedRun& run, const std::string& key, const RunResult& result,
                  const std::vector<std::string>& files);

}  // namespace forage
