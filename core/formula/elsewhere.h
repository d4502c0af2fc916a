// How a formula of another language is written here.
#pragma once

#include <string>
#include <string_view>

namespace forage {

/// A hint for a text that no formula has at this place, such as "?" or ": volt"; empty when none is known.
std::string hint_for_text(std::string_view text, bool in_equation);

/// A hint for a function that formulas do not have, such as "pow"; empty when none is known.
std::string hint_for_function(std::string_view name);

/// Whether this is what other tools call a unit, such as "ms".
bool is_unit(std::string_view name);

}  // namespace forage
