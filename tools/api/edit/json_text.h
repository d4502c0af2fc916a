// JSON that others have written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace forage {

/// How much is in a JSON text, counted without parsing it. Of a text with a mistake, the part before it
/// counts at least.
struct JsonSize {
    std::size_t depth = 0;       ///< lists and objects within each other
    std::size_t containers = 0;  ///< lists and objects
    std::size_t commas = 0;
};
JsonSize size_of_json(std::string_view text);

/// Throws InputError for more than 100 lists and objects within each other: what goes through them is
/// recursive.
void check_depth(const JsonSize& size);

/// Parses a text, of the file `name` if it is not empty. Throws InputError with the place of a mistake, and
/// what check_depth() throws.
nlohmann::json parse_json(const std::string& text, const std::string& name = {});
/// Throws what parse_json() throws.
void check_json(const std::string& text, const std::string& name);
/// The elements of a list without those that are null: texts unchanged, others as JSON.
std::vector<std::string> elements_of(const std::string& list);

}  // namespace forage
