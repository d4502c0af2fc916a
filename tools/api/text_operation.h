// A change of the text of a system as an operation of an editor.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace forage::editing {

/// The operation `text` that makes one text of a system of another one: it replaces the element of the
/// innermost item in which they differ. `before` is well-formed.
nlohmann::json text_operation(const std::string& before, const std::string& after);

}  // namespace forage::editing
