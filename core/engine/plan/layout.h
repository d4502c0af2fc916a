// The groups, modules and connections of a system, numbered before anything is compiled.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::engine {

/// What can be read of a system, in the order of update: byte order of ids (of the process, for a module).
/// Demand and Simulation know a group, a module or a connection by its index here. A layout never changes.
struct Layout {
    struct Group {
        std::string path;  ///< "Process/Group", with "#id" where that is ambiguous
        std::string id;
        GroupShape shape;
        NeuronType type;
        CellNames names = {};  ///< what its cells stand for, as far as that is known
    };
    /// A module that is enabled.
    struct Module {
        std::string process;  ///< name of the process that holds it
        std::string process_id;
        ModuleType type;
        ModulePorts ports;                             ///< without what a run decides, such as the seed
        std::vector<int> input_groups, output_groups;  ///< groups behind the ports; -1: unset
    };
    struct Connection {
        std::string id, name;
        SynapseType type;
        InputKind kind = InputKind::excitatory;  ///< beyond the three: a further input of the target's type
        int source = 0, target = 0;              ///< groups
        int state = 0;                           ///< of the source, which it transmits
        /// Whether the target's type reads this kind of input.
        bool effective = true;
    };
    std::vector<Group> groups;
    std::vector<Module> modules;
    std::vector<Connection> connections;
    double seconds_per_cycle = 0.04;
};

/// Makes the layout of a system. Reports what model::validate() finds, and returns nothing when that has
/// errors. Modules are checked against `environment`, which may be null.
std::optional<Layout> make_layout(const model::System& system, const Registry& registry,
                                  Diagnostics& diagnostics, Environment* environment = nullptr);

/// The parts of a system that a layout describes, in the same order.
struct UpdateOrder {
    explicit UpdateOrder(const model::System& system);
    std::vector<const model::Group*> groups;
    std::vector<const model::Process*> modules;  ///< processes with an enabled module
    std::vector<const model::Connection*> connections;
};

/// Returns the cross references of a module in the order of its ports, which the type declares; a type that
/// takes any ports has those of the file. The target of an unset one is empty.
std::vector<model::CrossReference> cross_references(const model::ModuleUse& use, const ModuleType& type,
                                                    bool outputs);

}  // namespace forage::engine
