// The files of the page, which are part of the program.
#pragma once

#include <optional>
#include <string>

#include "tools/studio/server/http_server.h"

namespace forage::studio {

/// The file for a path: "/" is the page, which only says how to build it in a build without Node. Empty when
/// there is no such file.
std::optional<Content> find_asset(const std::string& path);

}  // namespace forage::studio
