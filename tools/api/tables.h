// The tables that users give on the command line, resolved for a system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/engine/simulation.h"
#include "core/model/system.h"
#include "core/observe/clamp.h"
#include "modules/replay/drive_table.h"

namespace forage {

/// The tables of --clamp: files with rows, each of which is valid until the next row of its group. Reports
/// unknown groups and rows of a wrong length.
std::unique_ptr<observe::Clamp> make_clamp(const std::vector<std::string>& tables,
                                           const engine::Layout& layout, Diagnostics& diagnostics);

/// Reports the rows of a --replay table that no moduleReplay of the system plays.
void check_replay(const replay::DriveTable& table, const model::System& system, Diagnostics& diagnostics);

}  // namespace forage
