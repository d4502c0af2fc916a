// The content of a system file: plain values without behaviour. Everything that can be wrong knows its
// location in the file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/column.h"
#include "core/base/diagnostic.h"
#include "core/formula/formula.h"
#include "core/model/arborization.h"
#include "core/model/number_formula.h"
#include "core/model/pattern.h"
#include "core/types/parameter.h"

namespace forage::model {

/// A number with a name. Formulas in braces use it: `<Parameter name="gain" value="{2 * lambda}"/>`.
struct Constant {
    std::string name;
    std::string value;  ///< a number, or a formula in braces
    std::string unit, doc;
    std::optional<double> minimum, maximum;  ///< values outside are errors
    /// Whether the element that uses a process file gives the value; its formula means what it means there.
    bool given = false;
    Location at, name_at, value_at;
    friend bool operator==(const Constant&, const Constant&) = default;
};

/// A parameter as written in the file. The type decides what the value means.
struct Setting {
    std::string name, value;
    Location name_at, value_at;
    std::string computed = {};  ///< the value of a formula in braces (compute()); empty for other values
    /// The text that the type reads as a parameter of this kind.
    const std::string& in_force(ParameterKind kind) const {
        return kind != ParameterKind::text && in_braces(value) && !computed.empty() ? computed : value;
    }
    friend bool operator==(const Setting&, const Setting&) = default;
};

/// A cross reference and its target: the id of a group or the name of a state; empty when unset.
struct CrossReference {
    std::string name, target;
    Location at;
    friend bool operator==(const CrossReference&, const CrossReference&) = default;
};

/// The values with which a state of all cells of a group, or of all synapses of a connection, begins.
struct Initial {
    std::string state;
    /// A number, a formula in braces, "normal(mean, deviation)" or "uniform(low, high)"; empty with a file.
    std::string value;
    std::string file = {};  ///< from the system's folder: a number per cell, or targets x sources
    std::string column =
        {};  ///< of a table whose first row names the columns; empty for a file of numbers only
    Location at = {}, state_at = {}, value_at = {}, file_at = {}, column_at = {};
    ArrayHandle array = {};
    friend bool operator==(const Initial&, const Initial&) = default;
};

/// The use of a neuron, synapse or module type, with the parameters that the file sets.
struct TypeUse {
    std::string type;
    std::vector<Setting> settings;
    std::optional<std::string> note;
    Location at;
    std::vector<Initial> initial = {};  ///< of neurons and synapses
    /// What compute() finds for parameters of a declared type that are not set: the values of constants.
    std::vector<Setting> defaults = {};
    /// The setting that holds for a parameter; null when the type's own default does.
    const Setting* setting(std::string_view parameter) const;
    friend bool operator==(const TypeUse& a, const TypeUse& b) {  // `defaults` follow from other members
        return a.type == b.type && a.settings == b.settings && a.note == b.note && a.initial == b.initial;
    }
};

/// A state of a type that a system declares.
struct DeclaredState {
    std::string name;
    std::string value;  ///< before the first cycle: a number, or a formula in braces; empty: 0
    std::string unit, doc;
    Location at, name_at, value_at;
    friend bool operator==(const DeclaredState&, const DeclaredState&) = default;
};

/// A text in a file.
struct PlacedText {
    std::string text;
    Location at;
    friend bool operator==(const PlacedText&, const PlacedText&) = default;
};

/// A neuron or synapse type that a system declares (core/equations).
struct TypeDeclaration {
    std::string name, doc;
    bool linked = false;                ///< whether it comes from the file of a linked process
    std::vector<Constant> constants;    ///< its parameters, with their defaults
    std::vector<DeclaredState> states;  ///< those that do not begin with 0, or have a unit or doc
    std::vector<PlacedText> equations;
    Location at, name_at;
    friend bool operator==(const TypeDeclaration&, const TypeDeclaration&) = default;
};

/// The lines of a type's equations, without remarks.
std::vector<std::string> equation_lines(const TypeDeclaration& type);

struct SynapseUse : TypeUse {
    std::vector<CrossReference> feedback;
    friend bool operator==(const SynapseUse&, const SynapseUse&) = default;
};

struct ModuleUse : TypeUse {
    std::vector<CrossReference> inputs, outputs;
    friend bool operator==(const ModuleUse&, const ModuleUse&) = default;
};

/// The largest coordinate of a place in the diagram, to either side.
inline constexpr int farthest_coordinate = 1'000'000;

/// The position and size of an icon in the diagram, in the diagram's units.
struct Icon {
    int x = 0, y = 0, width = 50, height = 50;
    friend bool operator==(const Icon&, const Icon&) = default;
};

/// A text that stands on a page of the diagram, apart from any item.
struct CanvasComment {
    std::string id, text;
    std::string color;  ///< Six hexadecimal digits after a number sign; empty for the usual colour
    Icon box{0, 0, 80, 30};
    Location at;
    friend bool operator==(const CanvasComment&, const CanvasComment&) = default;
};

/// Where the phantom of a group of another process is on the page of a process.
struct Phantom {
    std::string group;  ///< its id
    int x = 0, y = 0;
    friend bool operator==(const Phantom&, const Phantom&) = default;
};

struct RectTopology {
    int width = 1, height = 1;
    bool wrap_x = false;  ///< `cylinderVert`: the left edge meets the right one
    bool wrap_y = false;  ///< `cylinderHor`: the upper edge meets the lower one
    Formulas<RectTopology> formulas = {};
    friend bool operator==(const RectTopology&, const RectTopology&) = default;
};

/// A group in which only the listed cells exist. The index of a cell is its rank in row order.
struct SparseTopology {
    std::vector<Point> points;
    friend bool operator==(const SparseTopology&, const SparseTopology&) = default;
};

using Topology = std::variant<RectTopology, SparseTopology>;

/// The largest accepted extent of a group, which is width times height. The extent of a sparse group is that
/// of the rectangle around its points.
inline constexpr long long max_extent = 10'000'000;

/// The width, height and number of cells of a group with this topology. The number of cells is valid only
/// when the extent is at most `max_extent`; validate() refuses larger groups.
GroupShape shape(const Topology& topology);

struct Group {
    std::string id, name, color;
    Topology topology;
    TypeUse neuron;
    std::optional<std::string> note;
    std::optional<Icon> icon;
    std::vector<std::string> comments;  ///< the XML comments before and inside the element
    bool terse = false;  ///< whether its file gives a rectangle as attributes of the group, or leaves it out
    Location at;
    friend bool operator==(const Group&, const Group&) = default;
};

/// A group of a process file, by the name under which connections from outside reach it.
struct Port {
    std::string name, group;
    Location at, name_at, group_at;
    friend bool operator==(const Port&, const Port&) = default;
};

struct Process {
    std::string id, name, color, hostname, port, path;
    bool module_enabled = true;
    std::optional<ModuleUse> module;
    std::optional<std::string> note;
    std::optional<Icon> icon;
    std::vector<std::string> comments;
    std::vector<CanvasComment> canvas_comments;  ///< on the page of its groups
    std::vector<Phantom> phantoms;               ///< those that the file places
    std::vector<Constant> constants;             ///< of the process; they hide those of the system
    std::vector<Port> ports;                     ///< with them, the file of the process is a part
    std::string within;  ///< the id of the process in whose file it is linked; empty for the system's own
    std::vector<Group> groups;
    /// The process as the system's own file has it: one element for a process that is linked to the file
    /// `path` (relative to the system's file), none for other processes. It is what the writer writes; the
    /// other members hold the content of the linked file.
    std::vector<Process> placeholder;
    bool linked() const { return !placeholder.empty(); }
    Location at, path_at;
    friend bool operator==(const Process&, const Process&) = default;
};

/// The line of a connection in the diagram. A connection between two processes has three: on the page of the
/// system, from process to process, and on the page of each process, from or to the phantom of the other
/// group.
struct Line {
    int source_anchor = 0, target_anchor = 0;  ///< number of one of the 16 points around the icon
    std::vector<Point> vertices;  ///< on the page of its process; between processes, on that of the system
    std::vector<Point> source_vertices = {};  ///< between processes: on the page of the source's process
    std::vector<Point> target_vertices = {};  ///< the same for the target's process
    friend bool operator==(const Line&, const Line&) = default;
};

struct Connection {
    std::string id, name;
    std::string source, target;  ///< ids of groups
    InputKind kind = InputKind::excitatory;
    std::string input;  ///< a further input of the target's type, in place of the kind
    std::string state;  ///< of the source's type, which it transmits; empty: the output
    Pattern pattern;
    Arborization arborization;
    DistanceFunction attenuation, delay;
    std::optional<SynapseUse> synapse;
    std::optional<std::string> note;
    std::optional<Line> line;
    std::vector<std::string> comments;
    bool linked = false;  ///< whether it comes from the file of a linked process
    bool terse = false;  ///< whether its file leaves out elements; the writer leaves out those with a default
    bool terse_synapse = false;  ///< whether its file gives a fixed weight as an attribute, or leaves it out
    Location at, source_at, target_at, input_at, state_at;
    friend bool operator==(const Connection&, const Connection&) = default;
};

struct System {
    std::vector<std::string> instructions;  ///< processing instructions before the root, such as xml-model
    std::string id, name, author, date, port;
    double cycles_per_second = 25;  ///< the rate of the original's clock, Hz; 0: as fast as possible
    bool sync_plots = false;
    std::optional<std::string> note;
    std::vector<Process> processes;
    std::vector<Connection> connections;
    std::vector<std::string> comments;
    std::vector<CanvasComment> canvas_comments;  ///< on the page of the processes
    std::vector<Constant> constants;
    std::vector<TypeDeclaration> neuron_types, synapse_types;
    Formulas<System> formulas;
    Location at;
    friend bool operator==(const System&, const System&) = default;
};

/// The cycles in a second of the system's time, Hz. A system that runs as fast as possible has 25.
inline double cycles_per_second(const System& s) {
    return s.cycles_per_second > 0 ? s.cycles_per_second : 25;
}
/// The time of a cycle, s.
inline double seconds_per_cycle(const System& s) { return 1 / cycles_per_second(s); }

/// The content of an .iqrProcess file: a process with the connections among its groups and the types that
/// it uses. Processes that it links follow the first one.
struct ProcessFile {
    Process process;
    std::vector<Connection> connections;
    std::vector<TypeDeclaration> neuron_types = {}, synapse_types = {};
    std::vector<Process> parts = {};
    friend bool operator==(const ProcessFile&, const ProcessFile&) = default;
};

}  // namespace forage::model
