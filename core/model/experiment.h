// What an experiment file says: one system, run many times, and what is wanted of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::model {

/// What somebody asks for, in a language of its own, and where they wrote it.
struct Expression {
    std::string text;
    Location at{};  ///< no file: on the command line
    bool empty() const { return text.empty(); }
};

/// A change of a parameter while the system runs.
struct ScheduledChange {
    Expression when;    ///< a condition
    Expression change;  ///< "WHERE.parameter=value"
    std::string text() const { return when.text + ": " + change.text; }
};

/// Patterns that are laid over the activity of a group while the system runs.
struct ManipulationSpec {
    enum class Mode { clamp, add, multiply };
    Mode mode = Mode::clamp;
    Expression group;                          ///< "Process/Group"
    Expression cells;                          ///< one pattern, "(x,y)=value ...", or ...
    Expression patterns;                       ///< ... a file of patterns, as seen from the working directory
    std::uint64_t every = 1, step = 1;   ///< cycles between patterns; every so-manieth pattern
    std::optional<std::uint64_t> times;  ///< how often the list is played; empty: for ever
    bool backwards = false;
    Expression from, until;  ///< conditions; empty: from the first cycle, to the last
    std::string text;  ///< all of it, as written on the command line
};

/// A number that every run gives.
struct Measure {
    enum class Kind {
        success,   ///< share of the trials that reached the target, 0..1
        duration,  ///< mean length of the trials, s
        first,     ///< cycles until a condition held
        final,     ///< a quantity at the end
    };
    std::string name;
    Kind kind = Kind::success;
    Expression what;                          ///< the condition or quantity
    std::optional<std::uint64_t> last;  ///< of the trials only so many last ones
    Location at;
};

struct RecordingSpec {
    Expression column;
    std::uint64_t every = 1;  ///< cycles
};

/// A parameter that takes each of several values in turn.
struct Sweep {
    Expression parameter;  ///< "WHERE.parameter"
    std::vector<Expression> values;
};

struct Experiment {
    std::string path;
    std::string note;           ///< for people
    std::string system, world;  ///< files, as seen from the working directory; no world when empty
    Location system_at, world_at;
    std::optional<double> real_time_factor;  ///< s of the world per s of the clock, instead of the world's own
    bool noise = true;

    std::optional<std::uint64_t> cycles, trials;  ///< the length: one of these, or `seconds`
    std::optional<double> seconds;
    Location length_at;
    double trial_timeout = 300;  ///< s
    Expression until;                  ///< a condition that ends a run before its time; none when empty

    std::vector<std::uint64_t> seeds = {1};
    std::vector<Expression> settings;  ///< "WHERE.parameter=value"
    std::vector<ScheduledChange> changes;
    std::vector<ManipulationSpec> manipulations;
    std::vector<RecordingSpec> recordings;
    std::vector<Expression> plots;
    std::vector<Measure> measures;
    std::vector<Sweep> sweeps;  ///< every combination is run with every seed
};

}  // namespace forage::model
