// What a system file says: plain values, no behaviour; everything that can be wrong knows its place in the
// file.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/model/arborization.h"
#include "core/model/diagnostic.h"
#include "core/model/pattern.h"
#include "core/types/column.h"

namespace forage::model {

/// A parameter as written; what it means is the type's to say.
struct Setting {
    std::string name, value;
    Location name_at, value_at;
};

/// A named place and what stands in it: a group's id, or a state's name; empty when unset.
struct CrossReference {
    std::string name, target;
    Location at;
};

/// A neuron, synapse or module of a named type.
struct TypeUse {
    std::string type;
    std::vector<Setting> settings;
    std::optional<std::string> note;
    Location at;
};

struct SynapseUse : TypeUse {
    std::vector<CrossReference> feedback;
};

struct ModuleUse : TypeUse {
    std::vector<CrossReference> inputs, outputs;
};

/// Place in the diagram, in its units.
struct Icon {
    int x = 0, y = 0, width = 50, height = 50;
};

struct RectTopology {
    int width = 1, height = 1;
    bool wrap_x = false;  ///< `cylinderVert`: the left edge meets the right one
    bool wrap_y = false;  ///< `cylinderHor`: the upper edge meets the lower one
};

/// Only the listed cells exist; a cell's index is its rank in row order.
struct SparseTopology {
    std::vector<Point> points;
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
    Location at;
};

struct Process {
    std::string id, name, color, hostname, port, path;
    bool module_enabled = true;
    std::optional<ModuleUse> module;
    std::optional<std::string> note;
    std::optional<Icon> icon;
    std::vector<Group> groups;
    Location at;
};

/// The line that draws a connection.
struct Line {
    int source_anchor = 0, target_anchor = 0;  ///< which of the 16 points round the icon
    std::vector<Point> vertices;
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
    Location at, source_at, target_at;
};

struct System {
    std::string id, name, author, date, port;
    double cycles_per_second = 25;  ///< pace of the original; 0: as fast as it goes
    bool sync_plots = false;
    std::optional<std::string> note;
    std::vector<Process> processes;
    std::vector<Connection> connections;
    Location at;
};

}  // namespace forage::model
