// The tables of an experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/model/experiment.h"
#include "core/observe/table_file.h"
#include "core/run/experiment/result.h"

namespace forage {

/// One row per run: run, the swept parameters, seed, status (finished, stopped, failed), cycles, seconds,
/// trials and reached (in a world with trials), the measures, remark. A field without a number is empty.
std::string results_csv(const model::Experiment& experiment, const RunPlan& plan,
                        std::span<const RunResult> results);

/// The columns of results_csv() with their types, for other formats. A parameter is a number if all its
/// values are; where a run has no number, there is NaN or, for cycles and trials, 0. Names that repeat get a
/// ' at their end. All arguments must outlive the columns.
std::vector<observe::TableColumn> results_columns(const model::Experiment& experiment, const RunPlan& plan,
                                                  std::span<const RunResult> results);

/// One row per combination of swept values: the number of runs with results, and for each measure the mean,
/// standard deviation (n - 1), minimum and maximum over the seeds, with the number of runs that have it.
std::string summary_csv(const model::Experiment& experiment, const RunPlan& plan,
                        std::span<const RunResult> results);

/// How many runs had numbers that are not finite, and where the first of them had one; empty when none had.
std::string divergence_summary(const RunPlan& plan, std::span<const RunResult> results);

/// The warnings of the runs; one that several runs share appears once and says how many they are.
Diagnostics warnings_of(const RunPlan& plan, std::span<const RunResult> results);

/// What ended runs early or never happened in them, one sentence each, with the number of such runs.
std::vector<std::string> event_notes(std::span<const RunResult> results);

/// The summary as text, with mean +- standard deviation.
std::string summary_text(const model::Experiment& experiment, const RunPlan& plan,
                         std::span<const RunResult> results);

}  // namespace forage
