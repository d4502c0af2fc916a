// Checks whether a text is well-formed XML. For an error, tinyxml2 gives only the line of the element that it
// was in. It also accepts texts that have a NUL byte, two outermost elements, or entities that do not exist.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/xml/document.h"

namespace forage::xml {

/// Returns the name of the outermost element, as a part of the document's text. Reports the first fault and
/// returns nothing when the text is not what Document::parse() accepts. Only `source` and `line_starts` of
/// the document are used.
std::optional<std::string_view> find_root(const Document& document, std::string_view beginning,
                                          std::size_t max_nodes, Diagnostics& diagnostics);

}  // namespace forage::xml
