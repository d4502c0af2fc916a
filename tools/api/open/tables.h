// The tables that users give on the command line, resolved for a system.
#pragma once

#include "core/base/drive_table.h"
#include "core/model/system.h"

namespace forage {

/// Reports the rows of a --replay table that no moduleReplay of the system plays.
void check_replay(const DriveTable& table, const model::System& system, Diagnostics& diagnostics);

}  // namespace forage
