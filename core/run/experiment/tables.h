// The tables of an experiment.
#pragma once

#include <span>
#include <string>

#include "core/model/experiment.h"
#include "core/run/experiment/result.h"

namespace forage {

/// One row per run: run, the swept parameters, seed, status (finished, stopped, failed), cycles, seconds,
/// with trials also trials and reached, the measures, remark. Empty where there is no number.
std::string results_csv(const model::Experiment& experiment, std::span<const PlannedRun> runs,
                        std::span<const RunResult> results);

/// One row per combination of swept values: the number of runs that gave numbers, and over the seeds of these
/// the mean, standard deviation (n - 1), minimum and maximum of each measure, with the number of runs that
/// have it.
std::string summary_csv(const model::Experiment& experiment, std::span<const PlannedRun> runs,
                        std::span<const RunResult> results);

/// The same for people: mean +- standard deviation.
std::string summary_text(const model::Experiment& experiment, std::span<const PlannedRun> runs,
                         std::span<const RunResult> results);

}  // namespace forage
