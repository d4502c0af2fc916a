// The operations of an editor on a world, as JSON.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/world/model_texts.h"
#include "core/base/diagnostic.h"
#include "tools/api/edit/operation.h"

namespace forage::editing {

struct WorldEdit;
const std::vector<Operation<WorldEdit>>& world_operations();

/// Carries out an operation on the text of a world. Returns the id of what it adds or changes, a list of
/// them, or null. Throws InputError and std::invalid_argument.
json carry_out_in_world(const json& operation, std::string& text, bug::ModelTexts& models);

/// Throws InputError when a text of the file `path` is not one of a world.
void check_world(const std::string& path, const std::string& text);

/// What is wrong with a world of this text, which would be the file `path`, as `forage world` says it;
/// pictures of its floors are not read.
Diagnostics problems_of_world(const std::string& path, const std::string& text);

}  // namespace forage::editing
