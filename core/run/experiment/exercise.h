// Exercises: whether a system of a user's own has and does what an experiment file requires.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/engine/plan/layout.h"
#include "core/model/experiment.h"
#include "core/run/experiment/result.h"

namespace forage {

/// The experiment of an exercise with another system. It has no sweeps, because the system's own parameters
/// count, and measures what the exercise requires.
model::Experiment with_system(model::Experiment experiment, const std::string& system);

/// Reports groups and connections that `start`, the system that users complete, has and `own` does not, if
/// the experiment names them. Warns of groups of another size, and of modules that are disabled only in
/// `own`.
void check_own(const model::Experiment& experiment, const model::System& start, const model::System& own,
               Diagnostics& diagnostics);

/// What became of a requirement.
struct Finding {
    std::string what;
    bool met = false;
    std::string advice;  ///< a sentence that says what may be wrong; empty when the requirement is met
};

/// The findings of an exercise, in the order of its requirements. Numbers that are measured are means over
/// all runs. `experiment` is with_system()'s, and `results` are those of its runs. Names that `system` does
/// not have are reported as errors.
std::vector<Finding> findings(const model::Experiment& experiment, std::span<const RunResult> results,
                              const model::System& system, const engine::Layout& layout,
                              Diagnostics& diagnostics);

}  // namespace forage
