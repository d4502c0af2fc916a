// What the program says of a robot's trials.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/run/environment.h"
#include "core/run/trial_recorder.h"

namespace forage::tool {

/// Lines for people: what each one is about, and its text.
std::vector<std::pair<std::string, std::string>> trial_summary(const Environment& environment,
                                                               const MeasuredTrials& trials);

}  // namespace forage::tool
