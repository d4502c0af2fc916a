// A system that runs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/plan/demand.h"
#include "core/engine/plan/layout.h"
#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::engine {

/// Whether this build can share cycles among threads (CMake option FORAGE_THREADS). Otherwise every
/// simulation runs on one thread.
bool has_threads();

/// A type's update or a module's start failed; the message names the type, its place in the system and the
/// cycle.
class RunError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Where a system began to diverge: a state of a cell that an update left NaN or infinite.
struct NotFinite {
    int group = 0, state = 0;
    Index cell = 0;
    std::uint64_t cycle = 0;
    double value = 0;
};

/// Runs a system cycle by cycle. A cycle is
///
///     update_groups()       each group reads what was delivered at the end of the last cycle
///     update_modules()      each module reads this cycle's activity of its input groups
///     update_connections()  each connection delivers what its target reads in the next cycle
///
/// each in byte order of ids. So A's activity of cycle t is B's input of cycle t + 1, plus the connection's
/// delay; what a module writes in t is excitatory input of t + 1. An input is the sum of what modules write,
/// in the order of their cross references, and then of what connections deliver. States may be read between
/// the phases. Activities that the demand lets users overwrite may be overwritten after update_groups().
class Simulation {
  public:
    struct Options {
        std::uint64_t seed = 1;
        int threads = 1;  ///< at most, for a cycle's loops; the numbers do not depend on it
        /// ns that a cycle's updates and deliveries take on one thread; shorter ones stay there. 0: all are
        /// shared.
        double parallel_threshold_ns = 5'000;
        /// ns on one thread, in a shared cycle: no part of a group takes less, nor do deliveries for which
        /// all threads meet.
        double min_task_ns = 1'250;
        Environment* environment = nullptr;  ///< given to the modules; must outlive the simulation
        bool general_forms =
            false;  ///< compile every connection to a list of synapses (slower, same numbers)
    };
    /// Checks a system and compiles it for what `demand` needs: groups on which nothing of it depends, nor a
    /// module, are pruned. They are not updated, nothing is delivered to them, and plastic connections to
    /// them do not learn; all other numbers are the same as without pruning. Empty when `diagnostics` got an
    /// error.
    static std::optional<Simulation> build(const model::System& system, const Registry& registry,
                                           const Demand& demand, const Options& options,
                                           Diagnostics& diagnostics);
    /// The same for a system that make_layout() has checked: `layout` is its result.
    static std::optional<Simulation> build(const model::System& system, Layout layout, const Demand& demand,
                                           const Options& options, Diagnostics& diagnostics);
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// What the system consists of; the numbers below are indices into it.
    const Layout& layout() const;

    /// Starts the modules; once, before the first cycle. Throws RunError.
    void start();
    /// One cycle. Throws RunError, also before start(). A simulation that has thrown in a cycle cannot go on.
    void step();
    void update_groups();
    void update_modules();
    void update_connections();  ///< ends the cycle

    int threads() const;  ///< that may share a cycle
    /// How many cycles they have shared.
    std::uint64_t shared_cycles() const;
    std::uint64_t cycle() const;  ///< the number of completed cycles; the next one has this number

    /// Searches the states of every group that is updated for numbers that are not finite, or no longer does.
    /// A new simulation does not search. The search ends with the first such number.
    void check_finite(bool wanted);
    /// The first one that was found: in the first group of the first cycle, by states, then by cells.
    const std::optional<NotFinite>& not_finite() const;

    // Parameters while the system runs. An assignment names something by its id in the system that was built.

    /// Reports what set() would refuse, and what the types find wrong when these are made in this order.
    void check(std::span<const model::Assignment> changes, Diagnostics& diagnostics) const;
    /// Changes a parameter, which its type reads from the next update on. Throws RunError for parameters that
    /// are read at start only and for modules that are disabled, and std::logic_error within a cycle, unless
    /// the demand lets users overwrite activities there.
    void set(const model::Assignment& change);

    /// All that decides the cycles to come, and what can be looked at now: states, inputs, parameters, what
    /// modules keep. Between cycles, after start(); to be read into a simulation of the same system, built
    /// with the same seed. Throws ArchiveError when it does not fit, and RunError for modules of a type that
    /// does not declare what it keeps.
    void checkpoint(Archive& archive);

    // What is read here is of the running cycle, or of the last one between cycles. Reading what the demand
    // did not name and what was therefore pruned throws a std::logic_error.

    bool pruned(int group) const;  ///< nothing that is demanded depends on it
    /// Input as the neuron read it, with the gain that its type applies.
    ConstColumn input(int group, InputKind kind) const;
    ConstColumn state(int group, int state) const;
    /// Activity, to overwrite after update_groups(). To be called again in every cycle. Throws
    /// std::logic_error for a group that the demand does not let users overwrite.
    Column output(int group);
    /// The same for any state: what its next update reads of the last cycle.
    Column writable_state(int group, int state);
    /// Makes the next update of a group a full one. To be called when anything that it depends on has changed
    /// by other means than set(), output() and writable_state().
    void invalidate(int group);

    ConstColumn module_output(int module, int port) const;
    bool has_written(int module, int port) const;  ///< the module has taken the output at least once

    std::string_view connection_form(int connection) const;  ///< how it was compiled
    std::size_t synapses(int connection) const;              ///< their number
    /// State of a connection whose synapses have their own, per synapse; empty for others.
    ConstColumn synapse_state(int connection, int state) const;

  private:
    struct Parts;
    explicit Simulation(std::unique_ptr<Parts> parts);

    std::unique_ptr<Parts> parts_;
};

}  // namespace forage::engine
