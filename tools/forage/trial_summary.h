// The part of the summary about a robot's trials.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/run/environment.h"
#include "core/run/trial_recorder.h"

namespace forage::tool {

/// The lines of the summary: a title and a text for each. `explained`: an explanation of the run follows.
std::vector<std::pair<std::string, std::string>> trial_summary(const Environment& environment,
                                                               const MeasuredTrials& trials, bool explained);

}  // namespace forage::tool
