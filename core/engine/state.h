// Everything that changes in a run: what a checkpoint writes and a digest reads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/archive.h"
#include "core/base/huge_pages.h"
#include "core/engine/plan/plan.h"

namespace forage::engine {

struct GroupState {
    std::unique_ptr<NeuronInstance> neuron;  ///< holds parameters
};

/// What a run knows about a batch of groups; cycle.h explains how a cycle uses it.
struct BatchState {
    bool quiescent = false;      ///< with this input an update changes nothing
    bool delivered = false;      ///< the other row of `inputs` holds what the next update reads
    bool same_input = false;     ///< ... which is what the last update read
    bool looks = false;          ///< this update finds out whether the batch is quiescent
    bool receives = false;       ///< this cycle's delivery is not what the batch has already
    bool silent = false;         ///< the activity is 0; known of large batches only
    bool finite = true;          ///< no update that was checked gave a state NaN or an infinity
    bool alike = true;           ///< the parameters of all groups are the same
    std::size_t row = 0;         ///< the row of `inputs` that the last update read; the second row receives
    std::uint64_t same_for = 0;  ///< updates in a row with the same input
    std::int64_t changed = 0;    ///< the last cycle whose activity differed from that of the cycle before

    std::vector<NeuronColumns::State> states;                  ///< their rings
    std::array<std::array<double*, 2>, input_kinds> inputs{};  ///< of this and of the next cycle, in turns
    double* past = nullptr;                                    ///< ring of past activity
};

struct ModuleState {
    std::unique_ptr<ModuleInstance> module;
    std::vector<ConstColumn> in;
    std::vector<Column> out;
    std::vector<char> written, changed;  ///< per output: in this cycle; changed: with other numbers
    std::vector<char> ever_written;      ///< per output
    std::vector<Eigen::ArrayXd> last;    ///< what small outputs held before
};

struct DeliveryState {
    bool changed = false;                  ///< from outside, since it delivered
    bool alike = true;                     ///< the parameters of all connections are the same
    std::unique_ptr<Workspace> workspace;  ///< of the joint kernel, as in ConnectionState
};

struct ConnectionState {
    std::unique_ptr<SynapseInstance> synapse;  ///< holds parameters
    std::vector<Ring> feedback;                ///< of a plastic one
    std::unique_ptr<Workspace> workspace;      ///< of its kernel; holds nothing that is of later use
};

struct State {
    State() = default;
    State(const State&) = delete;  // it points into itself
    State& operator=(const State&) = delete;

    std::vector<GroupState> groups;
    std::vector<ModuleState> modules;
    std::vector<ConnectionState> connections;
    std::vector<BatchState> batches;
    std::vector<DeliveryState> deliveries;
    HugeVector<double> numbers;  ///< all states, inputs, outputs; Plan says where
    bool started = false;
    std::uint64_t cycle = 0;  ///< the number of completed cycles
    std::uint64_t shown = 0;  ///< the cycle whose numbers are read

    /// Allocates the numbers and gives them their initial values. The instances of the types exist already.
    void begin(const Plan& plan);
    /// Notes that parameters of a group or a connection have changed.
    void compare_batch(const Plan& plan, int group);
    void compare_delivery(const Plan& plan, int connection);
    /// Writes or reads all of it. Throws what Simulation::checkpoint() throws.
    void checkpoint(const Plan& plan, Archive& archive);
};

/// The parameters that `object` holds, bit by bit.
std::string parameter_bytes(const std::vector<Parameter>& parameters, NeuronInstance& object);
std::string parameter_bytes(const std::vector<Parameter>& parameters, SynapseInstance& object);

/// Returns a batch's state in a cycle that its ring still holds.
inline double* state_row(const BatchState& b, const BatchPlan& plan, std::size_t state, std::uint64_t cycle) {
    const auto& s = b.states[state];
    if (s.depth == 1) return s.ring;  // saves a division for every connection
    return s.ring + static_cast<Index>(cycle % static_cast<std::uint64_t>(s.depth)) * plan.stride;
}

/// Returns a batch's activity in a cycle that its ring still holds.
inline double* activity_row(const BatchState& b, const BatchPlan& plan, std::uint64_t cycle) {
    return state_row(b, plan, static_cast<std::size_t>(plan.output), cycle);
}

/// Returns the same for a group.
inline double* state_row(const State& state, const Plan& plan, int group, int number, std::uint64_t cycle) {
    const auto& g = plan.groups[group];
    return state_row(state.batches[g.batch], plan.batches[g.batch], static_cast<std::size_t>(number), cycle) +
           g.first;
}

}  // namespace forage::engine
