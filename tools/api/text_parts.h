// A change of a text as parts that are replaced: an operation of an editor.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace forage::editing {

/// The operation `replace` that makes one text of another one. Its parts are the lines that differ, and as
/// much around them as each needs to occur only once; a long line counts as several, one for each tag.
nlohmann::json replace_operation(const std::string& before, const std::string& after);

/// A text in which an operation `replace` has replaced its parts, one after the other. Throws InputError when
/// a part does not occur exactly once, and json::exception for members that are missing.
std::string with_parts_replaced(std::string text, const nlohmann::json& operation);

}  // namespace forage::editing
