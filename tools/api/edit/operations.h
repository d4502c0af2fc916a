// The operations of an editor on a system, as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/model/system.h"
#include "core/types/registry.h"
#include "tools/api/edit/edit_files.h"
#include "tools/api/edit/operation.h"

namespace forage::editing {

struct SystemEdit;
const std::vector<Operation<SystemEdit>>& system_operations();

/// Carries out an operation on a system. Returns the id that it made, a list of them, or null. Throws what
/// the functions of core/model/operations.h throw, InputError, and json::exception for a value of another
/// type. Operations on parts write `files`.
json carry_out(const json& operation, model::System& system, const Registry& registry, EditFiles& files);
/// What an operation does, in a few words.
std::string title_of(const json& operation, const model::System& system);

}  // namespace forage::editing
