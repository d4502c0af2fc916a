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

#include "core/engine/first_failure.h"
#include "core/engine/parallel_tuner.h"
#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::engine {

struct GroupPlan;
struct ModulePlan;
struct Plan;
class EarlyDelivery;
class ParallelExecutor;

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

/// What somebody will look at in a run, beside its modules.
struct Demand {
    std::vector<int> groups{};
    std::vector<int> connections{};  ///< for the states of their synapses
    struct Output {
        int module, port;
    };
    std::vector<Output> outputs{};  ///< of modules, whoever reads their groups
    std::vector<int> inputs{};      ///< groups of which the inputs are looked at: see keep_inputs()
};

/// Runs a system cycle by cycle. A cycle is
///
///     update_groups()       each group reads what was delivered at the end of the last cycle
///     update_modules()      each module reads this cycle's activity of its input groups
///     update_connections()  each connection delivers what its target reads in the next cycle
///
/// each in byte order of ids. So A's activity of cycle t is B's input of cycle t + 1, plus the connection's
/// delay; what a module writes in t is excitatory input of t + 1. An input is the sum of what modules write,
/// in the order of their cross references, and then of what connections deliver. Between the phases, states
/// may be looked at and, after update_groups(), activities may be overwritten.
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
    /// Checks the system and builds it. Empty when `diagnostics` got an error.
    static std::optional<Simulation> build(const model::System& system, const Registry& registry,
                                           Options options, Diagnostics& diagnostics);
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// Leaves out, from now on, all groups that nobody reads: those that are not observed, that no module
    /// takes as an input, and from which no connection leads, directly or by way of others, to one that is.
    /// They are not updated and nothing is delivered to them; plastic connections to them do not learn.
    /// What is read has the same bits as ever. When nothing at all is read, nothing is left out: who runs
    /// such a system wants to see it run. To be called before start(), at most once; without it everything is
    /// updated. Who then looks at what is left out gets a std::logic_error.
    void prune(const Demand& observed);

    /// Keeps, from now on, the inputs of these groups only between cycles: what is delivered to others takes
    /// the place of what they have read, so that less memory is moved. Who then asks for their input() gets a
    /// std::logic_error. To be called before start(), at most once; without it all are kept.
    void keep_inputs(std::span<const int> groups);

    /// Starts the modules; once, before the first cycle. Throws RunError.
    void start();
    /// One cycle. Throws RunError, also before start(). A simulation that has thrown in a cycle cannot go on.
    void step();
    void update_groups();
    /// The same when nobody changes anything before update_connections(): what can be delivered already, is,
    /// as in step(). Who overwrites something all the same gets a std::logic_error.
    void update_groups_and_deliver();
    void update_modules();
    void update_connections();  ///< ends the cycle

    int threads() const;  ///< that may share a cycle
    /// How many cycles they have shared.
    std::uint64_t shared_cycles() const { return shared_cycles_; }
    std::uint64_t cycle() const {
        return cycle_;
    }  ///< the number of completed cycles; the next one has this number

    /// Whether updates are looked at for numbers that are not finite; at first they are not. Ends with the
    /// first one.
    void watch(bool wanted);
    /// The first one that was seen: in the first group of the first cycle, by states, then by cells.
    const std::optional<NotFinite>& not_finite() const { return not_finite_; }

    // Parameters while the system runs. An assignment names something by its id in the system that was built.

    /// Reports what set() would refuse, and what the types find wrong when these are made in this order.
    void check(std::span<const model::Assignment> changes, Diagnostics& diagnostics) const;
    /// Changes a parameter; to be called between phases. Its type reads it from the next update on: of the
    /// running cycle, if that is still to come. Throws RunError for parameters that are read at start only
    /// and for modules that are disabled.
    void set(const model::Assignment& change);

    /// All that decides the cycles to come, and what can be looked at now: states, inputs, parameters, what
    /// modules keep. Between cycles, after start(); to be read into a simulation of the same system, built
    /// with the same seed. Throws ArchiveError when it does not fit, and RunError for modules of a type that
    /// does not declare what it keeps.
    void checkpoint(Archive& archive);

    // Groups, numbered in order of update. What is read here is of the running cycle, or of the last one
    // between cycles.
    int groups() const;
    const std::string& path(int group) const;  ///< "Process/Group", with "#id" where that is ambiguous
    const std::string& id(int group) const;
    GroupShape shape(int group) const;
    const NeuronType& type(int group) const;
    bool pruned(int group) const;  ///< nobody reads it: prune()
    /// Input as the neuron read it, with the gain that its type applies.
    ConstColumn input(int group, InputKind kind) const;
    ConstColumn state(int group, int state) const;
    /// Activity, to overwrite after update_groups(). To be asked for again in every cycle.
    Column output(int group);
    /// The same for any state: what its next update reads of the last cycle.
    Column writable_state(int group, int state);
    /// To be told after anything that its next update depends on was changed by other means than set() and
    /// output().
    void group_changed(int group);

    // Modules that are enabled, in order of update.
    int modules() const;
    const std::string& module_process(int module) const;
    const std::string& module_type(int module) const;  ///< name of the type
    const ModulePorts& module_ports(int module) const;
    ConstColumn module_output(int module, int port) const;
    bool has_written(int module, int port) const;  ///< the module has taken the output at least once

    // Connections, in order of update.
    int connections() const;
    const std::string& connection_id(int connection) const;
    const std::string& connection_name(int connection) const;
    std::string_view connection_form(int connection) const;  ///< how it was compiled
    std::size_t synapses(int connection) const;
    const SynapseType& synapse_type(int connection) const;
    /// State of a connection whose synapses have their own, per synapse; empty for others.
    ConstColumn synapse_state(int connection, int state) const;

  private:
    Simulation(std::unique_ptr<Plan> plan, const Options& options);
    void bind_inputs(ModulePlan& module);

    std::unique_ptr<Plan> plan_;
    bool begin_sharing();
    void update_groups(bool deliver_early);
    void update_alone();
    /// The group, to be changed. Throws std::logic_error where that would come too late.
    GroupPlan& changing(int group);
    void deliver_early(int group);
    void deliver_late();

    double parallel_threshold_ns_;
    ParallelTuner<> trial_;
    std::unique_ptr<ParallelExecutor> shared_cycle_;  ///< null when one thread does all
    bool shared_ = false;                        ///< the running cycle
    std::uint64_t shared_cycles_ = 0;
    std::unique_ptr<EarlyDelivery> early_;
    bool delivers_early_ = false;   ///< the running cycle
    FirstFailure failed_delivery_;  ///< of groups that were delivered to early, in the running cycle
    bool started_ = false, observers_known_ = false, inputs_known_ = false;
    std::uint64_t cycle_ = 0;
    std::optional<NotFinite> not_finite_;
    std::uint64_t shown_ = 0;  ///< the cycle whose numbers are looked at
};

}  // namespace forage::engine
