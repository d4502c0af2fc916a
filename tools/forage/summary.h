// What the program says of a run at its end.
#pragma once

#include <string>

#include "core/run/prepared_run.h"

namespace forage::tool {

/// A few lines for people. `resumable`: there is a checkpoint from which the run can go on.
std::string summary(const PreparedRun& prepared, const RunOutcome& outcome, bool resumable);

}  // namespace forage::tool
