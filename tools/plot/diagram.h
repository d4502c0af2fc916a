// Diagram: processes, groups and connections, at the positions that the file gives. If it does not give all
// positions on a sheet, the sheet is laid out in layers: boxes stand below those from which arrows lead to
// them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/system.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// The processes of a system and the connections between them.
Picture system_diagram(const model::System& system);

/// The groups of a process and their connections. Connected groups of other processes, which have dashed
/// borders, are above them, or in layers with them. `process` must belong to `system`.
Picture process_diagram(const model::System& system, const model::Process& process);

/// A sheet with the diagram of the system and those of all its processes.
Picture diagram(const model::System& system, const std::string& title);

}  // namespace forage::plot
