// Pictures of the results of an experiment: measures over parameters, learning over trials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "tools/api/experiment/run_table.h"
#include "tools/plot/canvas.h"
#include "tools/plot/plot_spec.h"

namespace forage {

/// The pictures that fit the table: a curve or heat map per measure, and learning where there are trials.
std::vector<std::string> usual_plots(const RunTable& table, const std::string& directory);

/// A curve or heat map of a measure. Reports a measure that is not there, or that cannot be drawn so.
std::optional<plot::Picture> draw_measure(const plot::PlotSpec& spec, const RunTable& table,
                                          const std::string& title, Diagnostics& diagnostics);

/// The runs of a condition of an experiment, or a single run.
struct RunSeries {
    std::string name;
    std::vector<std::string> directories;
};
/// The share of trials that reached the target, or the mean of a column of trials.csv, in blocks of trials;
/// of a single run, the share among the last 20 trials after each of them. `table` is the table of the trials
/// of all runs, if there is one; otherwise each run has its own. `part` says which part of the runs these
/// are. Throws FileError. Reports a column that is not there.
std::optional<plot::Picture> draw_learning(const plot::PlotSpec& spec, const std::vector<RunSeries>& series,
                                           const std::string& table, const std::string& title,
                                           const std::string& part, Diagnostics& diagnostics);
/// The series of an experiment, one per condition.
std::vector<RunSeries> run_series(const RunTable& table, const std::string& directory);

}  // namespace forage
