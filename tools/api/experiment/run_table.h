// The table of an experiment's runs, and what was varied in it.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// The table of an experiment's runs, results.csv.
struct RunTable {
    struct Row {
        std::string run;  ///< the name of its directory, below runs/
        std::string seed;
        std::vector<std::string> values;              ///< of the parameters
        std::vector<std::optional<double>> measures;  ///< empty where a run has no number
    };
    std::vector<std::string> parameters, measures;
    std::vector<Row> rows;
    bool trials = false;  ///< whether the runs have trials
    std::string part;     ///< what keep_runs() has kept, such as "seed = 1"; empty for all runs
};

/// Whether a directory holds the results of an experiment.
bool holds_experiment(const std::string& directory);
/// Whether runs have directories there. Those that parts executed may have none.
bool has_runs(const std::string& directory);
/// Reads the table of an experiment. Throws FileError.
RunTable read_run_table(const std::string& directory);

/// Keeps the runs that `where` describes: "PARAMETER=VALUE" or "seed=VALUE". The last part of a parameter's
/// name suffices if no other one ends so. Several values of one parameter are all kept. Reports names and
/// values that the table does not have.
void keep_runs(RunTable& table, const std::vector<std::string>& where, Diagnostics& diagnostics);

/// The runs with the same values of all parameters.
struct Condition {
    std::vector<std::string> values;
    std::vector<const RunTable::Row*> rows;

    /// The numbers of a measure, of the runs that have one.
    std::vector<double> numbers(std::size_t measure) const;
};
/// All conditions, in the order of the table, to which they refer.
std::vector<Condition> conditions_of(const RunTable& table);

/// Something that was varied: a parameter, or several that vary together.
struct Axis {
    std::vector<std::size_t> parameters;
    std::string name;                 ///< the names of the parameters
    std::vector<std::string> values;  ///< different ones, in the order of the table

    /// The index of the value that a condition has.
    std::size_t value_of(const Condition& condition) const;

    std::unordered_map<std::string, std::size_t> indices = {};  ///< of the values
};
/// What was varied in the table: parameters with several values. Parameters vary together when the table has
/// not all combinations of their values.
std::vector<Axis> axes_of(const RunTable& table);

/// The values of some axes in a condition: "threshold = 0.2, weight = 1".
std::string name_of(const Condition& condition, const std::vector<Axis>& axes, const RunTable& table);

}  // namespace forage
