// Systems, worlds and parameters as JSON, for programs that show them. docs/design/studio-protocol.md
// describes the members.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "bug_interface/simulation/world.h"
#include "core/run/run.h"

namespace forage {

/// The processes, groups and connections of a run that has started, with their places in the diagram.
nlohmann::json describe_system(const Run& run);
/// The robots, objects and fixed solids of a world, with the part of the floor that a map shows.
nlohmann::json describe_world(const bug::World& world);
/// The parameters of a group, process or connection, by path, name or id, with their present values, ranges
/// and meanings. Throws InputError.
nlohmann::json describe_parameters(Run& run, std::string_view item);

}  // namespace forage
