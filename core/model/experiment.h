// The content of an experiment file: systems that are run many times, and what is measured.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/expression.h"

namespace forage::model {

/// What can be measured of a robot, see docs/reference/experiment.md.
inline constexpr std::array robot_quantities = {"path length", "displacement", "collisions", "target visits",
                                                "target distance"};

/// A number that is measured in every run.
struct Measure {
    enum class Kind {
        success,   ///< fraction of the trials that reached the target, 0..1
        duration,  ///< mean length of the trials, s
        distance,  ///< mean over the trials of the smallest distance to a target, m
        first,     ///< number of cycles until a condition first holds
        final,     ///< a quantity at the end of the run
        trials,    ///< fraction of the trials in which a condition held, 0..1
        cycles,    ///< number of cycles, outside resets, before which a condition held
        mean,      ///< mean of a quantity over all cycles
        minimum,   ///< smallest value of a quantity after any cycle
        maximum,   ///< largest value of a quantity after any cycle
        robot,     ///< one of robot_quantities
        share,     ///< fraction of the cycles, outside resets, after which a condition held, 0..1
        formula,   ///< arithmetic with the measures above it, by their names
    };
    std::string name;
    Kind kind = Kind::success;
    Expression what;                    ///< the condition, quantity or formula
    Expression of;                      ///< the name of the robot; empty: the first robot
    std::optional<std::uint64_t> last;  ///< only this many trials at the end are counted; empty: all
    Location at;
};

/// The names of the kinds of measures, in their order.
inline constexpr std::array measure_kinds = {"success", "duration", "distance", "first",   "final",
                                             "trials",  "cycles",   "mean",     "minimum", "maximum",
                                             "robot",   "share",    "formula"};
/// Reads of which trials a measure takes the mean, "all" or "last 100", from `what` to `last`. Reports an
/// error for another text. Does nothing for measures of something else.
void read_trials(Measure& measure, Diagnostics& diagnostics);

struct RecordingSpec {
    Expression column;
    std::uint64_t every = 1;  ///< cycles between two rows
    std::string format = {};  ///< csv, npy, npz, h5 or dat; empty: that of the run
};

/// A parameter that takes each of several values in turn, or several systems that take turns.
struct Sweep {
    Expression parameter;            ///< "WHERE.parameter"; "system" for systems
    std::vector<Expression> values;  ///< as in the file
    std::vector<std::string> files;  ///< the systems, relative to the working directory; else empty
    /// Sweeps with the same number take their values together: the first of each, the second of each, ...
    /// They stand one after the other. Every value of a number is combined with every value of the others.
    std::size_t axis = 0;
};

/// What a system must have or do in an exercise: a number within bounds.
struct Requirement {
    std::string what;    ///< such as "the robot reaches the light"
    std::string advice;  ///< what to say when it is missing; {n}, {all} and {value} stand for numbers
    std::optional<Measure> measure;  ///< empty: the number of synapses between these cells
    Expression from, to;             ///< "Process/Group" or some of its cells; no `from` means any group
    std::string kind;                ///< excitatory, inhibitory or modulatory; empty: any
    std::optional<double> at_least, at_most;
};

/// An exercise of a tutorial: users complete a system until it meets the requirements.
struct Exercise {
    std::string start;  ///< the system that users complete, relative to the working directory
    Location start_at;
    std::vector<Requirement> requirements;
};

/// How an experiment adds seeds to its combinations of values, in rounds, while it sees their results.
struct Adaptation {
    enum class Kind {
        confidence,  ///< until the 95 % interval of each combination's mean is narrow enough
        halving,     ///< the better half of the combinations gets twice as many seeds
    };
    Kind kind = Kind::confidence;
    Expression measure;                                     ///< the name of the measure that decides
    std::optional<double> width = {}, relative_width = {};  ///< of the interval; as a share of the mean
    std::uint64_t most = 100;                               ///< seeds of a combination, for confidence
    bool lowest = false;                                    ///< whether low numbers are good, for halving
    Location at;
};

struct Experiment {
    std::string path;
    std::string note;                 ///< a remark for readers
    std::vector<Expression> systems;  ///< files that run together, relative to the working directory
    std::string world;                ///< a file, relative to the working directory; empty without a world
    Location world_at;
    /// Seconds of the world per second of the clock. Empty for the world's own rate.
    std::optional<double> real_time_factor;
    bool noise = true;

    std::optional<std::uint64_t> cycles, trials;  ///< the length of a run: one of these, or `seconds`
    std::optional<double> seconds;
    Location length_at;
    double trial_timeout = 300;  ///< s
    Expression until;            ///< a condition that ends a run early; none when empty

    std::vector<std::uint64_t> seeds = {1};
    std::vector<Expression> settings;  ///< "WHERE.parameter=value"
    std::vector<Expression> robots;    ///< "NAME=NAME": the system's robot, the world's robot
    std::vector<ScheduledChange> changes;
    std::vector<ManipulationSpec> manipulations;
    std::vector<RecordingSpec> recordings;
    std::vector<Expression> plots;
    std::vector<Measure> measures;
    /// Every combination of their values is run with every seed. A swept system runs together with `systems`.
    std::vector<Sweep> sweeps;
    std::optional<Adaptation> adaptation;
    std::optional<Exercise> exercise;
};

/// Reports what an experiment's adaptation lacks: its measure, a width, seeds to begin with, something to
/// choose from.
void check_adaptation(const Experiment& experiment, Diagnostics& diagnostics);

}  // namespace forage::model
