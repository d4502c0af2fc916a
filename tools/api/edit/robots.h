// Groups for the ports of a module, and a robot as one step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::editing {

/// Gives ports of the module of a process, which lead nowhere, groups of the sizes that they need. Returns
/// the ids of the groups. Throws InputError for a port that does not exist or has a group.
std::vector<std::string> add_port_groups(model::System& system, const Registry& registry,
                                         const std::string& process, const std::vector<std::string>& ports);

/// Adds a process for the robot of this name in the world, with groups that drive it and that receive its
/// proximity and its light sensors. Returns the id of the process.
std::string add_robot(model::System& system, const Registry& registry, const std::string& robot,
                      const std::string& id);

/// The size nearest to `shape` that the module of a process accepts for a group at this port; nothing when
/// any will do, or when it follows from groups at other ports.
std::optional<GroupShape> size_at_port(const model::Process& process, const Registry& registry,
                                       const std::string& port, const GroupShape& shape);

}  // namespace forage::editing
