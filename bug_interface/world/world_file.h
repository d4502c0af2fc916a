// Whether a file can be a world at all.
#pragma once

#include <string>

#include "core/model/diagnostic.h"

namespace forage::bug {

/// Whether the file `path` may hold a world; `diagnostics` say what it is when it is something else.
bool looks_like_a_world(const std::string& path, Diagnostics& diagnostics);

}  // namespace forage::bug
