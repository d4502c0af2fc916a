// Tables and cells that a person gives on the command line, tied to a system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/engine/simulation.h"
#include "core/observe/clamp.h"
#include "modules/replay/drive_table.h"
#include "core/model/system.h"

namespace forage {

/// The tables of --clamp: files of rows, each of which holds until the next one of its group. Reports what
/// cannot be.
std::unique_ptr<observe::Clamp> make_clamp(const std::vector<std::string>& tables, const engine::Layout& layout,
                     Diagnostics& diagnostics);

/// Reports the rows of --replay that no moduleReplay of the system plays.
void check_replay(const replay::DriveTable& table, const model::System& system, Diagnostics& diagnostics);

}  // namespace forage
