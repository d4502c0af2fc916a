// Pictures of the results of an experiment: measures over parameters, learning over trials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "tools/plot/canvas.h"
#include "tools/plot/plot_spec.h"

namespace forage {

/// The table of an experiment's runs, results.csv.
struct RunTable {
    struct Row {
        std::string run;                              ///< the name of its directory, below runs/
        std::vector<std::string> values;              ///< of the parameters
        std::vector<std::optional<double>> measures;  ///< empty where a run has no number
    };
    std::vector<std::string> parameters, measures;
    std::vector<Row> rows;
    bool trials = false;  ///< whether the runs have trials
};

/// Whether a directory holds the results of an experiment.
bool holds_experiment(const std::string& directory);
/// Reads the table of an experiment. Throws FileError.
RunTable read_run_table(const std::string& directory);

/// The pictures that fit the table: a curve or heat map per measure, and learning where there are trials.
std::vector<std::string> usual_plots(const RunTable& table, const std::string& directory);

/// A curve or heat map of a measure. Reports a measure that is not there, or that cannot be drawn so.
std::optional<plot::Picture> draw_measure(const plot::PlotSpec& spec, const RunTable& table,
                                          const std::string& title, Diagnostics& diagnostics);

/// The trials of a run, or of all runs of an experiment with these values of the parameters.
struct TrialSeries {
    std::string name;
    std::vector<std::string> directories;
};
/// The share of trials that reached the target, or the mean of a column of trials.csv, in blocks of trials.
/// Throws FileError. Reports a column that is not there.
std::optional<plot::Picture> draw_learning(const plot::PlotSpec& spec, const std::vector<TrialSeries>& series,
                                           const std::string& title, Diagnostics& diagnostics);
/// The series of an experiment, one per combination of values.
std::vector<TrialSeries> trial_series(const RunTable& table, const std::string& directory);

}  // namespace forage
