// What is wrong with a document, as JSON: with the item, and the field of its form.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "core/model/system.h"
#include "core/types/registry.h"
#include "tools/api/edit/document.h"

namespace forage::studio {

/// As problems_of(), and with the id of the item, its port or parameter, and whether that is all: the port or
/// the input is required, and leads nowhere (`unset`).
nlohmann::json problems_of(const std::vector<Document::Problem>& problems, const model::System& system,
                           const Registry& registry);

}  // namespace forage::studio
