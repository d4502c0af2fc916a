// XML files of other programs' formats as plain values, each with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::xml {

struct Attribute {
    std::string name, value;
    Location where;  ///< of the value's first character
};

struct Element {
    std::string name;
    std::string text;     ///< of its own, without the blanks round it
    Location where;       ///< of the '<'
    Location text_where;  ///< of the text's first character
    std::vector<Attribute> attributes;
    std::vector<Element> children;  ///< in file order

    /// Null when there is none.
    const Attribute* attribute(std::string_view wanted) const;
    /// The first element that a path of names leads to ("inertia/izz"); null when there is none.
    const Element* child(std::string_view path) const;
};

/// The outermost element of `text`, which a person knows as `path`; when it is not well formed, says what and
/// where, and returns nothing. `beginning`, `most_nodes`: see Document::parse().
std::optional<Element> parse_element(std::string path, std::string text, std::string_view beginning,
                                     std::size_t most_nodes, Diagnostics& diagnostics);

}  // namespace forage::xml
