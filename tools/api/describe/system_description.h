// The description of a system in words: its groups, modules and connections, for terminals, papers and
// programs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/engine/simulation.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage {

/// A value of a parameter, a constant, or a state before the first cycle.
struct ValueDescription {
    std::string name;  ///< of a state: "v at start"
    std::string value, unit, doc;
    bool is_set = false;  ///< by the item that uses the type; otherwise the type's default is in force
};

/// A type in use, with the values that are in force: all parameters, and the declared states at start.
struct TypeDescription {
    std::string type;
    std::vector<ValueDescription> values;
};

struct GroupDescription {
    std::string id, name;
    std::string path;                      ///< "Process/Group"
    int width = 0, height = 0, cells = 0;  ///< a sparse group has fewer cells than width times height
    TypeDescription neuron;
    std::string notes;
};

/// A group that a module reads or writes.
struct PortDescription {
    std::string name, group;  ///< the cross reference, and the path of the group
    bool writes = false;
};

struct ProcessDescription {
    std::string id, name;
    std::string file;        ///< the process file that it is linked to; empty for other processes
    TypeDescription module;  ///< without a type when the process has no module
    bool module_enabled = true;
    std::vector<PortDescription> ports;
    std::vector<GroupDescription> groups;
    std::string notes;
};

struct ConnectionDescription {
    std::string id, name;
    std::string source, target;  ///< paths of groups
    std::string kind;            ///< excitatory, inhibitory, modulatory or an input, and " from " a state
    std::size_t synapses = 0;
    std::string form;  ///< how it is computed: "window", "list", ...
    double cost = 0;   ///< about how long a cycle of it takes, ns
    /// Which cells are paired, how a pair spreads into synapses, and how attenuation and delay follow from
    /// the distance; "none" for attenuations and delays that are 0.
    std::string pattern, arborization, attenuation, delay;
    std::string cells;  ///< the listed cells of the pattern; empty when it lists none
    TypeDescription synapse;
    std::string notes;
};

struct ConstantDescription {
    std::string name;  ///< "name", or "Process.name" for one of a process
    double value = 0;
    std::string unit, doc;  ///< may be empty
};

/// A type that the system declares or uses.
struct DeclarationDescription {
    std::string kind;  ///< "neuron", "synapse" or "module"
    std::string name, label, doc;
    bool declared = false;  ///< by the system, which the three following members are for
    std::vector<ConstantDescription> constants;
    std::vector<std::pair<std::string, std::string>> states;  ///< those with a value, as the file writes it
    /// A line each; of types that ship, shipped_equations(). Empty when they are not known.
    std::vector<std::string> equations;
};

struct SystemDescription {
    std::string name, author, date;
    double cycles_per_second = 0;  ///< Hz; 0: as fast as possible
    std::vector<ConstantDescription> constants;
    std::vector<DeclarationDescription> types;
    std::vector<ProcessDescription> processes;
    std::vector<ConnectionDescription> connections;
    std::string notes;
    std::size_t groups() const, cells() const, synapses() const;
};

/// Describes a system, and what was compiled from it: a connection that is not in `compiled`, which may be
/// null, is "not built" and has no synapses. `registry` has the types of the system.
SystemDescription describe(const model::System& system, const Registry& registry,
                           const engine::Simulation* compiled);

/// "1 group", "2 groups".
std::string number_of(std::size_t n, std::string_view what, std::string_view ending = "s");
/// "8 x 1", or "5 of 8 x 1" of a sparse group.
std::string size_of(const GroupDescription& group);

/// The description for a terminal: each connection below its source.
std::string as_text(const SystemDescription& description);
/// The tables of Nordlie, Gewaltig and Plesser (2009, PLoS Comput. Biol. 5:e1000456) in Markdown, with
/// typeset equations: a summary, constants, populations, connections, and each type with the values in force.
std::string as_markdown(const SystemDescription& description);
/// The same as a LaTeX fragment to include. It needs the packages amsmath, longtable, booktabs and array.
std::string as_latex(const SystemDescription& description);
/// A graph for Graphviz: groups in a cluster per process, connections in the colours of the diagram.
std::string as_dot(const SystemDescription& description);
/// An object with the members of SystemDescription, in JSON (RFC 8259).
std::string as_json(const SystemDescription& description);
/// The description in a format that is text, markdown, latex, dot or json. Throws std::invalid_argument.
std::string in_format(const SystemDescription& description, const std::string& format);

}  // namespace forage
