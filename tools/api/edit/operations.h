// The operations of an editor, as JSON: docs/design/studio-protocol.md lists them.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::editing {

using nlohmann::json;

/// Carries out an operation on the system of the file `path`. Returns the id that it made, a list of them, or
/// null. Throws what the functions of core/model/operations.h throw, InputError, and json::exception for
/// members that are missing.
json carry_out(const json& operation, model::System& system, const Registry& registry,
               const std::string& path);
/// What an operation does, in a few words.
std::string title_of(const json& operation, const model::System& system);

}  // namespace forage::editing
