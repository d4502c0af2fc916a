// Columns of a system by the names that users give them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/engine/simulation.h"
#include "core/model/expression.h"

namespace forage::observe {

/// One number per cell of a group: a state of its neurons, or an input. Or one number per synapse of a
/// connection: a state of its synapses.
struct ColumnRef {
    int group = 0;   ///< meaningless when `connection` is set
    int state = -1;  ///< -1: the input `kind`
    InputKind kind = InputKind::excitatory;
    std::string name;     ///< "Process/Group:state" or "Connection:state"
    int connection = -1;  ///< -1: cells of a group
};

/// The column that `text` names: "Process/Group:state", or "Process/Group" for the activity. States are those
/// of the group's type, and excIn, inhIn, modIn. Reports unknown names, with the possible ones; `what`
/// says where the text is from ("--record").
std::optional<ColumnRef> find_column(const engine::Layout& layout, std::string_view text,
                                     std::string_view what, Diagnostics& diagnostics, Location at = {});
/// The column that a piece of an expression names.
std::optional<ColumnRef> find_column(const engine::Layout& layout, const expression::Piece& piece,
                                     const expression::Context& context);

/// Whether a piece of an expression names a connection, "Connection:state", and no group.
bool names_connection(const engine::Layout& layout, const expression::Piece& piece);
/// The state of synapses that such a piece names. Reports unknown states and ambiguous names.
std::optional<ColumnRef> find_synapses(const engine::Layout& layout, const expression::Piece& piece,
                                       const expression::Context& context);

/// Demands the column.
inline void declare(const ColumnRef& c, engine::Demand& out) {
    if (c.connection >= 0) return out.read_synapses(c.connection);
    c.state < 0 ? out.read_input(c.group) : out.read_group(c.group);
}

/// The values of a column of cells in the running cycle, or, between cycles, in the last one.
inline ConstColumn values(const engine::Simulation& simulation, const ColumnRef& c) {
    return c.state >= 0 ? simulation.state(c.group, c.state) : simulation.input(c.group, c.kind);
}

}  // namespace forage::observe
