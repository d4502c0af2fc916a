// The operations of an editor on a world, as JSON: docs/design/studio-protocol.md lists them.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "bug_interface/world/model_texts.h"

namespace forage::editing {

using nlohmann::json;

/// Carries out an operation on the text of a world. Returns the id of what it adds or changes, a list of
/// them, or null. Throws InputError, std::invalid_argument, and json::exception for members that are missing.
json carry_out_in_world(const json& operation, std::string& text, bug::ModelTexts& models);

/// Throws InputError when a text of the file `path` is not one of a world.
void check_world(const std::string& path, const std::string& text);

}  // namespace forage::editing
