// The trials of all runs of an experiment, in one table.
#pragma once

#include <span>
#include <string>

#include "core/run/experiment/parts.h"
#include "core/run/experiment/plan.h"

namespace forage {

/// Writes the rows of the runs' trials.csv as one table at `path`, in the order of the runs and each behind
/// the run's name. The trials of a run stand in its line of `found`, or else in its directory; those of
/// failed runs do not count. An older table is removed; without trials there is none. Throws InputError for
/// runs whose trials are missing, and std::runtime_error when the table cannot be written.
void write_trials(const std::string& path, const RunPlan& plan, std::span<const RunResult> results,
                  const PartResults& found);

}  // namespace forage
