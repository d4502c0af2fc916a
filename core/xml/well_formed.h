// Well-formed XML, or what keeps a text from being it. tinyxml2 tells only the line of the element that it
// was in when it gave up, and reads on where a text is cut by a NUL, has two outermost elements or names
// entities that do not exist.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/xml/document.h"

namespace forage::xml {

/// Returns the name of the outermost element where it stands in the document's text; reports the first fault
/// of a text that is not what Document::parse() reads, and returns nothing then. Of the document, only
/// `source` and `line_starts` are used.
std::optional<std::string_view> find_root(const Document& document, std::string_view beginning,
                                          std::size_t most_nodes, Diagnostics& diagnostics);

}  // namespace forage::xml
