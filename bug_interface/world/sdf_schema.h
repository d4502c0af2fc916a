// What may stand where in an SDF file: the names of all elements of versions 1.2 to 1.9, and what they hold.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace forage::bug {

enum class Content {
    elements,
    anything,  ///< of a <plugin>: only who reads it knows
    text,
    truth,  ///< true, false, 1, 0
    number,
    whole_number,
    two_numbers,
    three_numbers,
    colour,  ///< red green blue, and alpha
    pose,    ///< x y z roll pitch yaw
};

/// What `element` in a `parent` holds; empty when the format has no such element there.
std::optional<Content> content_of(std::string_view element, std::string_view parent);
/// The names of the elements that may stand in a `parent`.
std::vector<std::string> known_children(std::string_view parent);
/// The attributes and elements without which an `element` means nothing.
std::vector<std::string_view> required_attributes(std::string_view element);
std::vector<std::string_view> required_children(std::string_view element);

}  // namespace forage::bug
