// Versions of the libraries behind the robot and its world.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace forage::bug {

/// Name and version of each.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace forage::bug
