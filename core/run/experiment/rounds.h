// Adaptive experiments: rounds of runs, each of which the results of the earlier ones decide.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run/experiment/plan.h"
#include "core/run/experiment/result.h"

namespace forage {

/// The number of seeds that each combination has in the next round; empty when a run of `plan`, the rounds so
/// far, has no result yet, when no round follows, and for an experiment that does not adapt itself. It is a
/// function of the results alone, in the order of the plan. So nothing but results needs to be kept, and
/// neither kills nor the number of workers change a decision.
std::optional<std::vector<std::size_t>> next_round(const model::Experiment& experiment, const RunPlan& plan,
                                                   std::span<const std::optional<RunResult>> results);

/// The results of a plan in the order of a later round's plan; its new runs have none.
std::vector<std::optional<RunResult>> carry_over(const RunPlan& plan,
                                                 std::vector<std::optional<RunResult>> results,
                                                 const RunPlan& later);

/// What the rounds have found, in a sentence: the best combination, or how many intervals are narrow enough.
/// Empty for an experiment that does not adapt itself.
std::string adaptation_note(const model::Experiment& experiment, const RunPlan& plan,
                            std::span<const RunResult> results);

}  // namespace forage
