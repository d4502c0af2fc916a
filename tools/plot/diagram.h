// Diagram: processes, groups and connections as the file lays them out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/system.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// The processes of a system with the connections between them.
Picture system_diagram(const model::System& system);

/// The groups of a process with their connections; groups of other processes that they are connected to stand
/// above, dashed. `process` is one of the system's.
Picture process_diagram(const model::System& system, const model::Process& process);

/// All of it on one sheet: the system, then its processes.
Picture diagram(const model::System& system, const std::string& title);

}  // namespace forage::plot
