// Observers: everything that reads or changes a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/engine/plan/demand.h"
#include "core/engine/simulation.h"
#include "core/observe/sim_time.h"

namespace forage {

class Environment;
class ResultFiles;
class Run;

/// The run as an observer sees it at one point of a cycle.
struct RunView {
    engine::Simulation& simulation;
    Environment* environment;  ///< null when the run has none
    SimTime time;  ///< the running cycle in before_cycle() and after_groups(), the next one in after_cycle()
    Run& run;
};

/// Reads or changes a run at fixed points of each cycle:
///
///     before_cycle()   schedules, measures of conditions
///     groups are updated
///     after_groups()   clamped, added and multiplied activities
///     modules and connections are updated, the environment advances
///     after_cycle()    recorders, plots, trial logs, films, checkpoints
///
/// Observers are called in the order in which they were added to the run. docs/how-to/write-an-observer.md
/// shows one.
class Observer {
  public:
    virtual ~Observer() = default;

    /// Adds everything that this observer reads or overwrites to `demand`. The run does not compute what no
    /// observer and no module demands.
    virtual void declare(engine::Demand& /*demand*/) const {}

    /// Reports what is impossible in the compiled system. Called once, before the first cycle.
    virtual void check(const engine::Simulation&, Diagnostics&) const {}

    virtual void before_cycle(RunView&) {}
    virtual void after_groups(RunView&) {}
    virtual void after_cycle(RunView&) {}

    /// Begins the files that grow during the run. Called once, before the first cycle of a run that is not
    /// resumed. Throws std::runtime_error.
    virtual void begin_files(ResultFiles&) {}
    /// The names of the files that finish() will write, if known before the run.
    virtual std::vector<std::string> file_names() const { return {}; }
    /// Writes the observer's files. Called once, after the last cycle, also of a run that failed or was
    /// stopped.
    virtual void finish(RunView&, ResultFiles&) {}

    /// Reads or writes everything that the observer needs to continue after a stop.
    virtual void checkpoint(Archive&) {}
};

}  // namespace forage
