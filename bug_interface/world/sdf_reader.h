// Reads SDF world files (Gazebo's format, version 1.4 and later) as the original simulator read them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// The world in file `path`. Empty when it could not be read; `diagnostics` then says why.
///
/// `model://NAME` is looked up in `extra_model_dirs`, in `models` and `../models` beside the world file, and
/// in the directories listed in the environment variables FORAGE_MODEL_PATH and GAZEBO_MODEL_PATH (separated
/// by colons). What strict readers of the format refuse is read as the original did: names may repeat,
/// everything is kept in file order, and only the first model of an included file counts.
std::optional<WorldDescription> read_world(const std::string& path, Diagnostics& diagnostics,
                                           const std::vector<std::string>& extra_model_dirs = {});

}  // namespace forage::bug
