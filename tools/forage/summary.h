// The summary of a run.
#pragma once

#include <string>

#include "core/run/prepared_run.h"

namespace forage::tool {

/// The summary of a run, a few lines. `resumable` says whether there is a checkpoint from which the run can
/// be resumed.
std::string summary(const PreparedRun& prepared, const RunOutcome& outcome, bool resumable);

}  // namespace forage::tool
