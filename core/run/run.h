// A run: a system, the environment that it acts in, and the observers that look at both.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/simulation.h"
#include "core/model/system.h"
#include "core/observe/observer.h"
#include "core/run/environment.h"
#include "core/run/input_error.h"
#include "core/run/memory_recorder.h"
#include "core/run/run_measures.h"
#include "core/run/run_spec.h"
#include "core/run/trial_recorder.h"
#include "core/types/registry.h"

namespace forage {

class ModuleFiles;
class StopCondition;
struct StopOrigin;

/// How Run::advance() ended before its length was reached.
struct EarlyEnd {
    bool held = false;    ///< whether the condition held
    std::string timeout;  ///< the trial that took too long, in words; empty when none did
};

/// Runs a system cycle by cycle in its environment and calls the observers at fixed points (observer.h). The
/// system is compiled at the first cycle, or by start(). Until then any observer may be added; afterwards
/// only observers whose demand is computed.
class Run {
  public:
    struct Options {
        std::uint64_t seed = 1;
        int threads = 1;  ///< largest number of threads; the results do not depend on it
        /// Whether all groups are computed, so that everything may be read and overwritten at any time.
        /// Otherwise only what observers and modules demand is computed, with the same numbers.
        bool compute_everything = true;
        bool check_finite = true;    ///< whether to search for NaN and infinities, see divergence()
        std::string directory = {};  ///< for the files of modules; they are not written when it is empty
    };
    /// Checks the system. Empty when `diagnostics` got an error. `environment` may be null.
    static std::optional<Run> make(model::System system, Registry registry,
                                   std::unique_ptr<Environment> environment, const Options& options,
                                   Diagnostics& diagnostics);
    Run(Run&&) noexcept;
    Run& operator=(Run&&) noexcept;
    ~Run();
    /// A run with the same system and environment, in its first state, with another seed. It shares what is
    /// constant, so that nothing is read, checked or compiled again; a system whose connections or initial
    /// values are random is compiled. It has no observers, and computes what this run computes, which it does
    /// not change. `directory` is as in Options. Throws InputError for an environment that cannot be
    /// restarted.
    Run restarted(std::uint64_t seed, const std::string& directory = {}) const;

    const model::System& system() const { return *system_; }
    const Registry& registry() const { return *registry_; }
    const engine::Layout& layout() const { return *layout_; }
    Environment* environment() const { return environment_.get(); }
    bool has_trials() const { return environment_ && environment_->has_trials(0); }
    std::uint64_t seed() const { return options_.seed; }

    /// Adds an observer, which is called after those that were added before. Throws InputError when the run
    /// was compiled without something that the observer demands.
    template <class T>
    T& add(std::unique_ptr<T> observer) {
        T& out = *observer;
        add_observer(std::move(observer));
        return out;
    }
    /// Removes an observer of this run. Its finish() is not called.
    void remove(const Observer& observer);
    std::span<const std::unique_ptr<Observer>> observers() const { return observers_; }
    /// The demand in addition to those of observers. Callers may add to it before the run starts.
    engine::Demand& demand() { return demand_; }

    /// Counts the groups on which no observer and no module depends, and none of the groups with the numbers
    /// in `read`: they would be pruned without Options::compute_everything. Returns 0 where that is not set.
    std::size_t prunable_groups(std::span<const int> read) const;
    /// Throws InputError, with the name of what is wanted, when the run was compiled without it. Does nothing
    /// before the run starts.
    void require(const engine::Demand& wanted, std::string_view name) const;

    /// Compiles the system for what the observers demand, lets the observers check it, and starts the
    /// modules. Returns false without starting when `diagnostics` has an error, even an earlier one.
    bool start(Diagnostics& diagnostics);
    /// Starts the run as start(Diagnostics&) does, but throws InputError for errors, and engine::RunError
    /// when a module cannot start. Does nothing when the run has started.
    void start();
    bool started() const { return simulation_.has_value(); }

    /// Runs one cycle of the system, its environment and the observers. Starts the run if necessary. Throws
    /// engine::RunError, also when an earlier cycle failed, and whatever an observer throws.
    void step();
    /// Runs until `length` is reached, counted from now. Returns the reason for an early end: the condition
    /// held, or a trial took too long. Empty when the end was not early.
    std::string until(const RunLength& length);
    /// Does the same, and calls `after_cycle` after each cycle, with the condition that will end the run and
    /// the time from which its length is counted. The callback may read and change the run, but not step it.
    /// What it throws ends the call; the run can continue. Throws InputError for a length that is impossible.
    using AfterCycle = std::function<void(const StopCondition&, const StopOrigin&)>;
    EarlyEnd advance(const RunLength& length, const AfterCycle& after_cycle = {});

    /// The compiled system. Starts the run if necessary.
    engine::Simulation& simulation() { return start(), *simulation_; }
    const engine::Simulation& simulation() const { return *simulation_; }  ///< requires started()
    std::uint64_t cycle() const { return simulation_ ? simulation_->cycle() : 0; }
    double seconds_per_cycle() const { return seconds_per_cycle_; }
    double seconds() const { return static_cast<double>(cycle()) * seconds_per_cycle_; }
    /// By how much of a cycle the run is ahead of the lengths in seconds that it was given, when the last one
    /// ended in this cycle. The next length in seconds is shorter by it, so that lengths add up.
    double overrun() const { return cycle() == overrun_at_ ? overrun_ : 0; }
    void set_overrun(double cycles) { overrun_ = cycles, overrun_at_ = cycle(); }
    SimTime time() const;
    /// The first number that was NaN or infinite, in words; empty while all numbers are finite.
    const std::string& divergence() const { return divergence_; }

    /// The numbers of a source such as "Bug/Light" or "Bug/Motor:vm(5,1)" in the last cycle, row by row.
    /// Throws InputError.
    std::vector<double> read(std::string_view source);
    /// Overwrites a state of all cells of a group. The next cycle reads it as the state of the last one.
    /// Throws InputError, also when `values` does not have one number per cell.
    void write(std::string_view column, std::span<const double> values);
    /// Changes a parameter between two cycles: "Process/Group.parameter=value", "Process.parameter=value" of
    /// a module, "Connection.parameter=value" of a synapse. Throws InputError. Warnings are added to
    /// `warnings`, if it is not null.
    void set(std::string_view assignment, Diagnostics* warnings = nullptr);
    /// Returns the change that set() would make. Throws InputError when set() would.
    model::Assignment check(std::string_view assignment, Diagnostics* warnings = nullptr);
    /// The present value of a parameter such as "Process/Group.threshold". Throws InputError.
    ParameterValue parameter(std::string_view name);

    /// Records a source in memory, from the next cycle on, every `every`-th cycle. Throws InputError.
    MemoryRecorder& record(std::string_view source, std::uint64_t every = 1);
    /// The trials of a robot, with the measures of its TrialRecorder; empty in a run without trials.
    MeasuredTrials trials(std::size_t robot = 0) const;

    /// The current values of measures of this run.
    std::vector<std::optional<double>> measure(RunMeasures& measures);

    /// Calls finish() of all observers, in order. They write their files to `files`.
    void finish(ResultFiles& files);

    /// Reads or writes everything that changes in the run. May be called between cycles, after start().
    void checkpoint(Archive& archive);
    /// Continues from the state of `old`, a run of a similar system with the same seed; this run must have
    /// done no cycle. Groups of the same type and topology, modules with the same ports, and connections with
    /// the same ends, pattern and type keep their states, and the cycle and the environment are those of
    /// `old`. Parameters are those of this run's system; everything else starts from its initial state.
    /// Throws ArchiveError and engine::RunError; this run must then be discarded. Observers keep nothing.
    void adopt(Run& old);
    /// The subtitle of pictures, such as "dac.iqr in arena.world, seed 1"; may be empty.
    std::string title;
    /// How the run was opened, as forage::save_state() needs it; empty for a run of a system built in code.
    std::string opened_as;
    /// A digest of everything in system and environment that decides the following cycles. Equal runs have
    /// equal digests.
    std::string digest();

  private:
    Run(std::shared_ptr<const model::System> system, std::shared_ptr<const Registry> registry,
        std::unique_ptr<Environment> environment, std::shared_ptr<const engine::Layout> layout,
        const Options& options);
    void add_observer(std::unique_ptr<Observer> observer);
    RunView view();

    std::shared_ptr<const model::System> system_;  ///< shared with restarted runs, like the next three
    std::shared_ptr<const Registry> registry_;
    std::shared_ptr<const engine::Layout> layout_;
    std::shared_ptr<const engine::Plan> plan_;  ///< of the run that this one restarts, until start()
    std::unique_ptr<Environment> environment_;
    Options options_;
    double seconds_per_cycle_;
    engine::Demand demand_;  ///< the demand for which the system is compiled
    std::vector<std::unique_ptr<Observer>> observers_;
    ModuleFiles* module_files_;                     ///< one of the observers
    std::optional<engine::Simulation> simulation_;  ///< destroyed first: its modules use the streams
    std::string divergence_;
    double overrun_ = 0;
    std::uint64_t overrun_at_ = 0;  ///< the cycle to which it belongs
    bool failed_ = false;  ///< whether a cycle threw; always false between cycles of a run that can continue
};

}  // namespace forage
