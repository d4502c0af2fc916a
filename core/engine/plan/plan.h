// What never changes during a run: a system compiled for a demand.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/engine/kernels/kernel.h"
#include "core/engine/plan/demand.h"
#include "core/engine/plan/layout.h"
#include "core/engine/rows.h"
#include "core/types/neuron_columns.h"

namespace forage::engine {

struct GroupPlan {
    Index cells = 0, stride = 0;         ///< stride: from row to row
    bool pruned = false;                 ///< nothing that is demanded depends on it
    bool keeps_input = true;             ///< else what is delivered takes the place of what was read
    bool overwritten = false;            ///< from outside
    int output = 0;                      ///< the state that is the activity
    bool shows_states = false;           ///< a connection transmits another state
    int history = 0;                     ///< longest delay of the connections that read its activity
    std::array<bool, max_inputs> fed{};  ///< the type reads this kind of input, and something delivers it
    std::vector<int> incoming;           ///< connections that end here, in order
    double delivery_cost = 0;            ///< of all of them, ns
    std::vector<std::pair<int, int>> module_inputs;  ///< modules and ports that write to it, in order
    std::vector<ParameterValue> parameters;          ///< with which a run begins, like those below

    // Where its numbers stand in State::numbers.
    struct StateRing {
        Rows::Offset first;
        std::int64_t depth;  ///< rows: cycles that are kept; row t % depth is that of cycle t
    };
    std::vector<StateRing> states;
    Index numbers = 0;                                             ///< of all rows of its states
    std::array<std::array<Rows::Offset, 2>, max_inputs> inputs{};  ///< two rows, the same one if not kept
    Rows::Offset past = 0;  ///< ring of history + 1 rows of activity; none when history is 0
};

struct ModulePlan {
    std::vector<ParameterValue> parameters;
    std::vector<Rows::Offset> outputs;
    std::vector<char> read;  ///< per output: something that is demanded depends on it
};

struct ConnectionPlan {
    std::unique_ptr<const Kernel> kernel;    ///< null when it is pruned
    const PlasticKernel* plastic = nullptr;  ///< the kernel, when its synapses have an update()
    std::vector<ParameterValue> parameters;
    int source = 0, target = 0;
    int state = 0;  ///< of the source, which it transmits
    int longest_delay = 0;
    InputKind kind = InputKind::excitatory;
    bool effective = true;      ///< the target's type reads this kind of input
    bool first = false;         ///< nothing delivers this kind of input to the target before it
    bool pruned = false;        ///< nothing that is demanded depends on it
    bool reads_states = false;  ///< of its synapses, from outside
    std::vector<int> feedback;  ///< for a plastic one: states of the target, -1 for an unset one
    std::size_t synapses = 0;
    Rows::Offset first_number = 0;  ///< of what a plastic kernel keeps, in State::numbers
    std::size_t numbers = 0;        ///< how many they are
    /// Source and target cell of each synapse, when `reads_states` is set and the kernel is plastic.
    std::vector<int> pre, post;
};

/// The numbers with which a state begins, unless they are those of its type.
struct FirstNumbers {
    int group = -1, connection = -1;  ///< one of them
    int state = 0;
    std::vector<double> values;  ///< one per cell or synapse
};

/// A compiled system. Groups, modules and connections have the numbers of the layout. Runs that differ only
/// in what Options says share it, unless the seed decides some of it.
struct Plan {
    Plan(std::shared_ptr<const Layout> of, const Demand& demanded)
        : shared_layout(std::move(of)), layout(*shared_layout), demand(demanded) {}

    std::shared_ptr<const Layout> shared_layout;
    const Layout& layout;
    Demand demand;                      ///< for which it is compiled
    std::optional<std::uint64_t> seed;  ///< that decides connections or first numbers
    std::vector<FirstNumbers> first_numbers;
    std::vector<GroupPlan> groups;
    std::vector<ModulePlan> modules;
    std::vector<ConnectionPlan> connections;
    Rows rows;  ///< of all numbers

    /// Updates of a cycle, and deliveries that need not wait for modules; cycle.h explains them.
    struct Step {
        int group;
        bool deliver;  ///< else update
    };
    std::vector<Step> steps;
    std::vector<int> late;     ///< groups that are delivered to after the modules, in order
    bool overwritten = false;  ///< activities of some groups may change between phases
};

}  // namespace forage::engine
