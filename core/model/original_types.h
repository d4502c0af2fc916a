// The types of the original that Forage does not have.
#pragma once

#include <span>
#include <string_view>

namespace forage::model {

/// A type that files of the original may name, and what a user can do instead.
struct OriginalType {
    std::string_view name;
    std::string_view reason;  ///< completes "Forage does not have the original's NAME: ..."
    std::string_view hint;
};

/// All of these types. docs/reference/compatibility.md lists them, too.
std::span<const OriginalType> missing_original_types();

/// The entry with this name; null when there is none.
const OriginalType* find_missing_original_type(std::string_view name);

}  // namespace forage::model
