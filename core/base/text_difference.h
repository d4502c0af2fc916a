// The difference of two texts, line by line.
#pragma once

#include <string>
#include <string_view>

namespace forage {

/// The difference as `diff -u` prints it, with three lines around each change. Empty when the texts are
/// equal.
std::string unified_difference(std::string_view before, std::string_view after, std::string_view name_before,
                               std::string_view name_after);

}  // namespace forage
