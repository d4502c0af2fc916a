// The file of a model's folder that says which file holds the model.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/diagnostic.h"

namespace forage::bug {

/// The path of the file that model.config in `folder` (or manifest.xml, as it was once called) names for the
/// newest version of SDF; an error, and nothing, when there is none. `where`: what asks for the model.
std::optional<std::string> file_of_model(const std::filesystem::path& folder, const Location& where,
                                         Diagnostics& diagnostics);

}  // namespace forage::bug
