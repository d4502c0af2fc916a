// What a system file says: plain values, no behaviour; everything that can be wrong knows its place in the
// file.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/model/arborization.h"
#include "core/base/diagnostic.h"
#include "core/model/pattern.h"
#include "core/base/column.h"

namespace forage::model {

/// A parameter as written; what it means is the type's to say.
struct Setting {
    std::string name, value;
    Location name_at, value_at;
    friend bool operator==(const Setting&, const Setting&) = default;
};

/// A named place and what stands in it: a group's id, or a state's name; empty when unset.
struct CrossReference {
    std::string name, target;
    Location at;
    friend bool operator==(const CrossReference&, const CrossReference&) = default;
};

/// A neuron, synapse or module of a named type.
struct TypeUse {
    std::string type;
    std::vector<Setting> settings;
    std::optional<std::string> note;
    Location at;
    friend bool operator==(const TypeUse&, const TypeUse&) = default;
};

struct SynapseUse : TypeUse {
    std::vector<CrossReference> feedback;
    friend bool operator==(const SynapseUse&, const SynapseUse&) = default;
};

struct ModuleUse : TypeUse {
    std::vector<CrossReference> inputs, outputs;
    friend bool operator==(const ModuleUse&, const ModuleUse&) = default;
};

/// Place in the diagram, in its units.
struct Icon {
    int x = 0, y = 0, width = 50, height = 50;
    friend bool operator==(const Icon&, const Icon&) = default;
};

struct RectTopology {
    int width = 1, height = 1;
    bool wrap_x = false;  ///< `cylinderVert`: the left edge meets the right one
    bool wrap_y = false;  ///< `cylinderHor`: the upper edge meets the lower one
    friend bool operator==(const RectTopology&, const RectTopology&) = default;
};

/// Only the listed cells exist; a cell's index is its rank in row order.
struct SparseTopology {
    std::vector<Point> points;
    friend bool operator==(const SparseTopology&, const SparseTopology&) = default;
};

using Topology = std::variant<RectTopology, SparseTopology>;

/// Largest extent of a group, width times height: of a sparse one, of the rectangle around its points.
inline constexpr long long most_cells = 10'000'000;

/// Width, height and number of cells of a group with this topology. Only where the extent is at most
/// `most_cells` does the number of cells hold; validate() refuses all others.
GroupShape shape(const Topology& topology);

struct Group {
    std::string id, name, color;
    Topology topology;
    TypeUse neuron;
    std::optional<std::string> note;
    std::optional<Icon> icon;
    std::vector<std::string> comments;  ///< the XML comments before and in it
    Location at;
    friend bool operator==(const Group&, const Group&) = default;
};

struct Process {
    std::string id, name, color, hostname, port, path;
    bool module_enabled = true;
    std::optional<ModuleUse> module;
    std::optional<std::string> note;
    std::optional<Icon> icon;
    std::vector<std::string> comments;
    std::vector<Group> groups;
    /// Of a process that is linked to the file `path` (relative to the system's), whose content stands here:
    /// what the system itself says of it, one element, and what is written. Empty for others.
    std::vector<Process> placeholder;
    bool linked() const { return !placeholder.empty(); }
    Location at, path_at;
    friend bool operator==(const Process&, const Process&) = default;
};

/// The line that draws a connection.
struct Line {
    int source_anchor = 0, target_anchor = 0;  ///< which of the 16 points round the icon
    std::vector<Point> vertices;
    friend bool operator==(const Line&, const Line&) = default;
};

struct Connection {
    std::string id, name;
    std::string source, target;  ///< ids of groups
    InputKind kind = InputKind::excitatory;
    Pattern pattern;
    Arborization arborization;
    DistanceFunction attenuation, delay;
    std::optional<SynapseUse> synapse;
    std::optional<std::string> note;
    std::optional<Line> line;
    std::vector<std::string> comments;
    bool linked = false;  ///< it comes from the file of a linked process
    Location at, source_at, target_at;
    friend bool operator==(const Connection&, const Connection&) = default;
};

struct System {
    std::vector<std::string> instructions;  ///< processing instructions before the root, such as xml-model
    std::string id, name, author, date, port;
    double cycles_per_second = 25;  ///< pace of the original; 0: as fast as it goes
    bool sync_plots = false;
    std::optional<std::string> note;
    std::vector<Process> processes;
    std::vector<Connection> connections;
    std::vector<std::string> comments;
    Location at;
    friend bool operator==(const System&, const System&) = default;
};

/// A process on its own, with the connections among its groups: what an .iqrProcess file says.
struct ProcessFile {
    Process process;
    std::vector<Connection> connections;
    friend bool operator==(const ProcessFile&, const ProcessFile&) = default;
};

}  // namespace forage::model
