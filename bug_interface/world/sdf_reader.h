// Reads SDF world files (Gazebo's format, version 1.4 and later) as the original simulator read them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// Reads the world in the file `path`. When it cannot be read, reports the errors and returns nothing.
///
/// `model://NAME` is looked up in `extra_model_dirs`, in `models` and `../models` beside the world file, and
/// in the directories listed in the environment variables FORAGE_MODEL_PATH and GAZEBO_MODEL_PATH (separated
/// by colons). Files that strict readers of the format refuse are read as in the original: names may be
/// repeated, with a warning where this misleads, the order of the file is kept, and only the first model of
/// an included file counts.
///
/// A `text` that is not empty is read instead of the file, as if it stood there.
std::optional<WorldDescription> read_world(const std::string& path, Diagnostics& diagnostics,
                                           const std::vector<std::string>& extra_model_dirs = {},
                                           const std::string& text = {});

}  // namespace forage::bug
