// One run of a system: what 'forage run' does once and an experiment many times.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/engine/simulation.h"
#include "core/observe/clamp.h"
#include "core/observe/manipulation.h"
#include "core/observe/schedule.h"
#include "tools/forage/commands.h"
#include "tools/forage/files.h"
#include "tools/forage/paths.h"
#include "tools/forage/plots.h"
#include "tools/forage/recordings.h"
#include "tools/forage/results.h"
#include "tools/forage/run_measures.h"
#include "tools/plot/film.h"

namespace forage::tool {

/// A system that has started, with its world and all that looks at it and pokes it.
struct Running {
    DirectoryHold hold;  ///< of the directory of results, if there is one
    Loaded loaded;
    engine::Simulation simulation;
    double seconds_per_cycle;  ///< of the world, or at the system's pace
    observe::Schedule schedule;
    std::optional<observe::Condition> until;
    observe::Clamp clamp;
    std::vector<observe::Manipulation> manipulations;
    RunMeasures run_measures;
    std::vector<Measures> measures;  ///< of the trials, one per robot
    LivePlots plots;
    std::optional<Recordings> recordings;  ///< none without a directory
    std::vector<PathLog> paths;            ///< one per robot, when they are wanted
    std::string diverged;  ///< where numbers began to be not finite; empty: all are finite, or they are not checked
    std::unique_ptr<plot::Film> film;  ///< none when it is not wanted
    std::uint64_t film_every = 1;      ///< cycles

    /// One cycle: changes that are due, the system, its world; then what was seen is written down. Throws
    /// what a cycle or a recording throws.
    void cycle();

    /// All of it that changes. Recordings come last: nothing is touched on the disk when something else does
    /// not fit.
    void checkpoint(Archive& archive);

    observe::SimTime now() const;  ///< before the next cycle
    double seconds() const { return static_cast<double>(simulation.cycle()) * seconds_per_cycle; }
    /// Whether the condition that ends the run holds.
    bool done() const { return until && until->holds(simulation, now()); }
};

/// Builds and starts everything but the recordings. Groups that nothing reads are pruned. Whatever is wrong
/// with what a user gave is found here, before the first cycle and before anything is written; empty when
/// `diagnostics` got an error.
std::optional<Running> prepare(const Sources& sources, const RunOptions& options, Diagnostics& diagnostics);

/// Runs from where it is to its end, or until something stops it, and writes what a run leaves behind.
/// Returns the exit status.
int carry_on(const RunOptions& options, const Sources& sources, Running& running);

/// How it went.
void note(const Running& running, Outcome& outcome);

/// Closes the recordings and writes the tables of trials: `outcome` gets the names of the files, in the run's
/// directory. What cannot be written does not keep the rest from being written. Returns what went wrong.
std::vector<std::string> write_tables(const RunOptions& options, Running& running, Outcome& outcome);

/// "_name" in the names of files about this robot, where there are several.
std::string robot_suffix(const bug::World& world, std::size_t robot);

}  // namespace forage::tool
