// Columns of a system by the names that users give them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/engine/simulation.h"
#include "core/model/expression.h"

namespace forage::observe {

/// One number per cell of a group: a state of its neurons, or an input.
struct ColumnRef {
    int group = 0;
    int state = -1;  ///< -1: the input `kind`
    InputKind kind = InputKind::excitatory;
    std::string name;  ///< "Process/Group:state"
};

/// The column that `text` names: "Process/Group:state", or "Process/Group" for the activity. States are those
/// of the group's type, and excIn, inhIn, modIn. Reports unknown names, with the possible ones; `what`
/// says where the text is from ("--record").
std::optional<ColumnRef> find_column(const engine::Layout& layout, std::string_view text,
                                     std::string_view what, Diagnostics& diagnostics, Location at = {});
/// The column that a piece of an expression names.
std::optional<ColumnRef> find_column(const engine::Layout& layout, const expression::Piece& piece,
                                     const expression::Context& context);

/// Demands the column.
inline void declare(const ColumnRef& c, engine::Demand& out) {
    c.state < 0 ? out.read_input(c.group) : out.read_group(c.group);
}

/// The values of the column in the running cycle, or, between cycles, in the last one.
inline ConstColumn values(const engine::Simulation& simulation, const ColumnRef& c) {
    return c.state >= 0 ? simulation.state(c.group, c.state) : simulation.input(c.group, c.kind);
}

}  // namespace forage::observe
