// Tables and cells that a person gives on the command line, tied to a system.
#pragma once

#include <string>
#include <vector>

#include "core/engine/simulation.h"
#include "core/observe/clamp.h"
#include "modules/replay/drive_table.h"
#include "tools/forage/load.h"

namespace forage::tool {

/// The tables of --clamp: files of rows, each of which holds until the next one of its group. Reports what
/// cannot be.
observe::Clamp clamp(const std::vector<std::string>& wishes, const engine::Layout& layout,
                     Diagnostics& diagnostics);

/// Reports the rows of --drive that no moduleReplay of the system plays.
void check_drive(const replay::DriveTable& table, const model::System& system, Diagnostics& diagnostics);

}  // namespace forage::tool
