// A model compiled against the types: what never changes during a run. The numbers live in an Arena.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/arena.h"
#include "core/engine/kernels/kernel.h"
#include "core/engine/kernels/plastic_kernel.h"
#include "core/engine/plan/demand.h"
#include "core/engine/plan/layout.h"

namespace forage::engine {

// What a cycle reads of every group and connection stands first: it then lies together in few lines of the
// cache.

struct GroupPlan {
    // What changes in a run; group_cycle.h says what it is for.
    bool rests = false;                   ///< with this input an update changes nothing
    bool delivered = false;               ///< the other row of `inputs` holds what the next update reads
    bool same_input = false;              ///< ... which is what the last update read
    bool silent = false;                  ///< the activity is 0; noticed for large groups only
    bool finite = true;                   ///< no update that was checked gave a state NaN or an infinity
    bool in_parts = false;                ///< this update is done in parts
    bool receives = false;                ///< this cycle's delivery is not what the group has already
    bool pruned = false;                  ///< nothing that is demanded depends on it
    bool keeps_input = true;              ///< else the two rows of `inputs` are one
    bool overwritten = false;             ///< from outside
    std::array<bool, input_kinds> fed{};  ///< the type reads this kind, and somebody delivers it
    int output = 0;                       ///< the state that is the activity
    std::size_t row = 0;         ///< the row of `inputs` that the last update read; the other one receives
    std::uint64_t same_for = 0;  ///< updates in a row with the same input
    std::int64_t changed = 0;    ///< the last cycle whose activity differed from that of the cycle before

    Index cells = 0, stride = 0;
    std::unique_ptr<NeuronInstance> neuron;
    std::vector<NeuronColumns::State> states;        ///< a state's ring: row t % depth is that of cycle t
    std::vector<int> incoming;                       ///< connections that end here, in order
    std::vector<std::pair<int, int>> module_inputs;  ///< modules and ports that write to this group, in order
    std::array<std::array<double*, 2>, input_kinds> inputs{};  ///< of this and of the next cycle, in turns
    double delivery_cost = 0;                                  ///< of all incoming connections, ns
    bool update_divides = false, delivery_divides = false;     ///< threads share it, part by part
    /// What the update of a part has found.
    struct Part {
        bool finite = true, silent = false;
    };
    std::vector<Part> parts;  ///< of a group that divides
    int history = 0;          ///< longest delay of outgoing connections; 0: no ring of past activity is kept
    double* history_ring = nullptr;  ///< row t % (history + 1) is the activity of cycle t
    RandomStream random;

    std::string path, id;  ///< path: "Process/Group"
    GroupShape shape;
    NeuronType type;
    std::vector<Arena::Offset> state_offsets;
    std::array<std::array<Arena::Offset, 2>, input_kinds> input_offsets{};
    Arena::Offset history_offset = 0;
};

struct ModulePlan {
    std::string process, process_id;
    ModuleType type;
    std::unique_ptr<ModuleInstance> module;
    ModulePorts ports;
    std::vector<int> input_groups, output_groups;  ///< -1: unset
    std::vector<Arena::Offset> output_offsets;
    std::vector<ConstColumn> in;
    std::vector<Column> out;
    std::vector<char> written,
        changed;  ///< per output: in this cycle; changed: and with something else than before
    std::vector<char> ever_written;    ///< per output: since the start
    std::vector<char> read;            ///< per output: something that is demanded depends on it
    std::vector<Eigen::ArrayXd> last;  ///< what small outputs held before
    static constexpr Index compared_output =
        1024;  ///< cells; of larger outputs only whether they are written
};

struct ConnectionPlan {
    std::unique_ptr<Kernel> kernel;
    PlasticKernel* plastic = nullptr;  ///< the kernel, when its synapses have states of their own
    int source = 0, target = 0;
    int longest_delay = 0;
    InputKind kind = InputKind::excitatory;
    bool effective = true;  ///< the target's type reads this kind of input
    bool first = false;     ///< nobody delivers this kind of input to the target before
    bool changed = false;   ///< from outside, since it delivered
    bool pruned = false;    ///< nothing that is demanded depends on it

    std::string id, name;
    std::unique_ptr<SynapseInstance> synapse;
    SynapseType type;
    std::vector<int> feedback;  ///< for a plastic one: states of the target, -1 for an unset one
    std::size_t synapses = 0;
};

/// Groups, modules and connections in the order in which a cycle updates them: byte order of their ids (of
/// the process, for a module).
struct Plan {
    Layout layout;
    std::vector<GroupPlan> groups;
    std::vector<ModulePlan> modules;
    std::vector<ConnectionPlan> connections;
    std::vector<int> updated;                        ///< groups that are not pruned, in order
    std::vector<std::unique_ptr<double[]>> scratch;  ///< per thread, for NeuronColumns of the widest group
    std::vector<std::vector<double>> before;         ///< per thread: states to compare with
    Arena arena;
    bool checks_finite = false;  ///< updates are searched for numbers that are not finite
    bool overwritten = false;    ///< activities of some groups may change between phases
};

/// What the numbers of a system may take: 16 GiB. Lists of synapses come on top.
inline constexpr double most_bytes = 16.0 * (1 << 30);

/// What a demand does not need: by the numbers of a layout, and outputs by module and port.
struct Pruned {
    std::vector<bool> groups, connections;
    std::vector<std::vector<bool>> outputs;
};

/// Finds the groups from which nothing that is demanded follows, nor a module's input.
Pruned prune(const Layout& layout, const Demand& demand);

/// Compiles a system for a demand. Empty when `diagnostics` got an error. Reports a system that takes more
/// than `most_bytes`, before it takes them, or more than there is. `layout` is that of the system.
std::unique_ptr<Plan> compile(const model::System& system, Layout layout, const Demand& demand,
                              std::uint64_t seed, Forms forms, Diagnostics& diagnostics);

}  // namespace forage::engine
