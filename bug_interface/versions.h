// The versions of the libraries that bug_interface uses.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace forage::bug {

/// The name and the version of each library.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace forage::bug
