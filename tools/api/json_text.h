// JSON that others have written.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace forage {

/// Parses a text, of the file `name` if it is not empty. Throws InputError with the place of a mistake, also
/// for more than 100 lists and objects within each other: what goes through them is recursive.
nlohmann::json parse_json(const std::string& text, const std::string& name = {});

}  // namespace forage
