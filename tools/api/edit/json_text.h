// JSON that others have written.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace forage {

/// Parses a text, of the file `name` if it is not empty. Throws InputError with the place of a mistake, and
/// what check_depth() throws.
nlohmann::json parse_json(const std::string& text, const std::string& name = {});
/// Throws what parse_json() throws.
void check_json(const std::string& text, const std::string& name);
/// The elements of a list without those that are null: texts unchanged, others as JSON.
std::vector<std::string> elements_of(const std::string& list);
/// Throws InputError for more than 100 lists and objects within each other: what goes through them is
/// recursive.
void check_depth(const nlohmann::json& value);

}  // namespace forage
