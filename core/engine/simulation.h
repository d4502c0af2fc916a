// Runs a system.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/connectivity/connect.h"
#include "core/engine/options.h"
#include "core/engine/plan/demand.h"
#include "core/engine/plan/layout.h"
#include "core/engine/run_error.h"
#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::engine {

/// Whether this build can share cycles among threads (CMake option FORAGE_THREADS). Otherwise every
/// simulation runs on one thread.
bool has_threads();

/// Where a system began to diverge: a state of a cell that an update left NaN or infinite.
struct NotFinite {
    int group = 0, state = 0;
    Index cell = 0;
    std::uint64_t cycle = 0;
    double value = 0;
};

struct Plan;
struct Unchanged;

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
    using Options = engine::Options;

    /// Checks a system and compiles it for what `demand` needs: groups on which nothing of it depends, nor a
    /// module, are pruned. They are not updated, nothing is delivered to them, and plastic connections to
    /// them do not learn; all other numbers are the same as without pruning. Empty when `diagnostics` got an
    /// error.
    static std::optional<Simulation> build(const model::System& system, const Registry& registry,
                                           const Demand& demand, const Options& options,
                                           Diagnostics& diagnostics);
    /// Compiles a system that make_layout() has checked; `layout` is its result.
    static std::optional<Simulation> build(const model::System& system, Layout layout, const Demand& demand,
                                           const Options& options, Diagnostics& diagnostics);
    /// The same. Shares the plan of another simulation of this system instead of compiling it again, if it
    /// fits the demand, and the seed does not decide it. `plan` may be null.
    static std::optional<Simulation> build(const model::System& system, std::shared_ptr<const Layout> layout,
                                           const Demand& demand, const Options& options,
                                           Diagnostics& diagnostics, std::shared_ptr<const Plan> plan);
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// Returns what the system consists of; groups, modules and connections are numbered by it.
    const Layout& layout() const;
    /// Returns the compiled system, which never changes.
    std::shared_ptr<const Plan> plan() const;

    /// Starts the modules; once, before the first cycle. Throws RunError.
    void start();
    /// Runs one cycle. Throws RunError, also before start(). A simulation that has thrown in a cycle cannot
    /// continue.
    void step();
    void update_groups();
    void update_modules();
    void update_connections();  ///< ends the cycle

    /// Returns the number of threads that may share a cycle.
    int threads() const;
    /// Returns the number of cycles that threads have shared.
    std::uint64_t shared_cycles() const;
    /// Returns the number of completed cycles, which is also the number of the next cycle.
    std::uint64_t cycle() const;

    /// Switches on or off the search of every updated group for states that are not finite. It is off in a
    /// new simulation, and ends with the first such number.
    void check_finite(bool wanted);
    /// Returns the first number that the search found: in order of cycles, then groups, states and cells.
    const std::optional<NotFinite>& not_finite() const;

    // Parameters may change while the system runs. An assignment names its owner by the id in the system.

    /// Reports what set() would refuse, and what the types find wrong when the changes are made in this
    /// order.
    void check(std::span<const model::Assignment> changes, Diagnostics& diagnostics) const;
    /// Changes a parameter, which its type reads from the next update on. Throws RunError for parameters that
    /// are read at start only and for modules that are disabled, and std::logic_error within a cycle, unless
    /// the demand lets users overwrite activities there.
    void set(const model::Assignment& change);

    /// Gives a connection, whose type multiplies by a constant, other synapses in this simulation: as many,
    /// of the same cells and delays, as those of the system, with their own attenuations. It must not be
    /// pruned.
    void replace_synapses(int connection, connectivity::Synapses synapses);
    /// Returns those synapses; none when they were not replaced.
    const connectivity::Synapses& replaced_synapses(int connection) const;
    /// Sets a state of the synapses of a connection that is not pruned, one number per synapse, in the order
    /// of connectivity::connect().
    void set_synapse_state(int connection, int state, std::span<const double> values);
    /// Returns the present value of a parameter. Throws RunError for a module that is disabled.
    ParameterValue parameter(const model::Assignment& which) const;

    /// Writes or reads all that decides the cycles to come, and what can be read now: states, inputs,
    /// parameters, what modules keep. It is called between cycles, after start(). A checkpoint is read into a
    /// simulation of the same system, built with the same seed. Throws ArchiveError when it does not fit, and
    /// RunError for modules of a type that does not declare what it keeps.
    void checkpoint(Archive& archive);
    /// Continues from the state of `old`, a simulation of a similar system (adopt.h). Both must have started,
    /// and this one must have done no cycle. Throws ArchiveError; this simulation must then be discarded.
    void adopt(const Simulation& old, const Unchanged& unchanged);

    // The numbers that follow are those of the running cycle, or between cycles those of the last one.
    // Reading what was pruned, because the demand did not name it, throws std::logic_error.

    /// Returns whether a group is pruned: nothing that is demanded depends on it.
    bool pruned(int group) const;
    /// Returns a group's input as its cells read it, with the gain that their type applies.
    ConstColumn input(int group, InputKind kind) const;
    /// Returns a state of a group, one number per cell.
    ConstColumn state(int group, int state) const;
    /// Returns whether state() returns the same memory in every cycle, so that what it returned stays
    /// current.
    bool in_place(int group, int state) const;
    /// Returns a group's activity, to overwrite after update_groups(). It must be called again in every
    /// cycle. Throws std::logic_error for a group that the demand does not let users overwrite.
    Column output(int group);
    /// Returns any state of such a group, to overwrite what its next update reads of the last cycle.
    Column writable_state(int group, int state);

    /// Returns what a module wrote last to an output.
    ConstColumn module_output(int module, int port) const;
    /// Returns whether a module has written to an output at least once.
    bool has_written(int module, int port) const;

    /// Returns the name of the kernel form to which a connection was compiled, or "pruned".
    std::string_view connection_form(int connection) const;
    /// Returns about how long a cycle of the connection takes on one thread, in ns.
    double connection_cost(int connection) const;
    /// Returns the number of a connection's synapses.
    std::size_t synapses(int connection) const;
    /// Returns a state of a connection's synapses, one number per synapse; empty when they have none.
    ConstColumn synapse_state(int connection, int state) const;
    /// Returns the source cells of the synapses that have states, in the same order.
    std::span<const int> synapse_sources(int connection) const;
    /// Returns their target cells.
    std::span<const int> synapse_targets(int connection) const;

  private:
    struct Parts;
    explicit Simulation(std::unique_ptr<Parts> parts);

    std::unique_ptr<Parts> parts_;
};

}  // namespace forage::engine
