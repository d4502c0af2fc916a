// Folders that are named where a world file is wanted.
#pragma once

#include <string>

#include "core/base/diagnostic.h"

namespace forage::bug {

/// Whether `path` is a folder; `diagnostics` say so then, and which worlds are in it.
bool is_a_folder(const std::string& path, Diagnostics& diagnostics);

}  // namespace forage::bug
