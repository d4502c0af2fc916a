// What the cells of groups stand for: what modules say of their ports, carried along the wiring.
#pragma once

#include "core/engine/plan/layout.h"

namespace forage::engine {

/// Gives the groups of a layout the names of their cells. A group at a port of a module has those of the
/// port. A group whose cells each drive a cell with a name has these names, such as the cell behind a motor
/// cell; and a cell that is driven only by cells of one name has this name.
void name_cells(const model::System& system, Environment* environment, Layout& layout);

}  // namespace forage::engine
