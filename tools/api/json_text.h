// JSON that others have written.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace forage {

/// Parses a text, of the file `name` if it is not empty. Throws InputError with the place of a mistake, and
/// what check_depth() throws.
nlohmann::json parse_json(const std::string& text, const std::string& name = {});
/// Throws InputError for more than 100 lists and objects within each other: what goes through them is
/// recursive.
void check_depth(const nlohmann::json& value);

}  // namespace forage
