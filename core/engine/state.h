// Everything that changes in a run: what a checkpoint writes and a digest reads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/archive.h"
#include "core/base/huge_pages.h"
#include "core/connectivity/connect.h"
#include "core/engine/options.h"
#include "core/engine/plan/plan.h"

namespace forage::engine {

/// What a run knows about a group; cycle.h explains how a cycle uses it.
struct GroupState {
    std::unique_ptr<NeuronInstance> neuron;  ///< holds parameters
    RandomStream random;

    bool quiescent = false;      ///< with this input an update changes nothing
    bool delivered = false;      ///< the other row of `inputs` holds what the next update reads
    bool same_input = false;     ///< ... which is what the last update read
    bool looks = false;          ///< this update finds out whether the group is quiescent
    bool receives = false;       ///< this cycle's delivery is not what the group has already
    bool silent = false;         ///< the activity is 0; known of large groups only
    bool finite = true;          ///< no update that was checked gave a state NaN or an infinity
    std::size_t row = 0;         ///< the row of `inputs` that the last update read; the second row receives
    std::uint64_t same_for = 0;  ///< updates in a row with the same input
    std::int64_t changed = 0;    ///< the last cycle whose activity differed from that of the cycle before

    std::vector<NeuronColumns::State> states;                 ///< their rings
    std::array<std::array<double*, 2>, max_inputs> inputs{};  ///< of this and of the next cycle, in turns
    double* past = nullptr;                                   ///< ring of past activity
};

struct ModuleState {
    std::unique_ptr<ModuleInstance> module;
    ModulePorts ports;
    std::vector<ConstColumn> in;
    std::vector<Column> out;
    std::vector<char> written, changed;  ///< per output: in this cycle; changed: with other numbers
    std::vector<char> ever_written;      ///< per output
    std::vector<Eigen::ArrayXd> last;    ///< what small outputs held before
};

struct ConnectionState {
    std::unique_ptr<SynapseInstance> synapse;  ///< holds parameters
    bool changed = false;                      ///< from outside, since it delivered
    std::vector<Ring> feedback;                ///< of a plastic one
    std::unique_ptr<Workspace> workspace;      ///< of its kernel; holds nothing that is of later use
    connectivity::Synapses own;                ///< those of this run, in place of the plan's; often empty
    std::unique_ptr<const Kernel> own_kernel;  ///< of these; else null
};

struct State {
    /// The state in which a run begins.
    State(const Plan& plan, const Options& options);
    State(const State&) = delete;  // it points into itself
    State& operator=(const State&) = delete;

    std::vector<GroupState> groups;
    std::vector<ModuleState> modules;
    std::vector<ConnectionState> connections;
    HugeVector<double> numbers;  ///< all states, inputs, outputs; Plan says where
    bool started = false;
    std::uint64_t cycle = 0;  ///< the number of completed cycles
    std::uint64_t shown = 0;  ///< the cycle whose numbers are read

    /// Writes or reads all of it. Throws what Simulation::checkpoint() throws.
    void checkpoint(const Plan& plan, Archive& archive);
};

/// Gives a connection of this run synapses of its own, with which it has the same delays at most.
void replace_synapses(const Plan& plan, ConnectionState& c, int connection, connectivity::Synapses synapses);

/// Returns what computes a connection in this run.
inline const Kernel* kernel_of(const ConnectionPlan& plan, const ConnectionState& c) {
    return c.own_kernel ? c.own_kernel.get() : plan.kernel.get();
}

/// Returns a group's state in a cycle that its ring still holds.
inline double* state_row(const GroupState& g, const GroupPlan& plan, int state, std::uint64_t cycle) {
    const auto& s = g.states[static_cast<std::size_t>(state)];
    if (s.depth == 1) return s.ring;  // saves a division for every connection
    return s.ring + static_cast<Index>(cycle % static_cast<std::uint64_t>(s.depth)) * plan.stride;
}

/// Returns a group's activity in a cycle that its ring still holds.
inline double* activity_row(const GroupState& g, const GroupPlan& plan, std::uint64_t cycle) {
    return state_row(g, plan, plan.output, cycle);
}

}  // namespace forage::engine
