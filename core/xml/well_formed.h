// Well-formed XML, or what keeps a text from being it. tinyxml2 tells only the line of the element that it
// was in when it gave up, and reads on where a text is cut by a NUL, holds two roots or names entities that
// do not exist.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace forage::xml {

struct Fault {
    std::size_t offset;  ///< of the byte to point at
    std::string message;
    std::string hint;
    bool of_the_whole = false;  ///< nothing in particular to point at
};

/// The first thing in `text` that keeps it from being a well-formed XML 1.0 document in UTF-8, without
/// entities of its own, not nested deeper than any file of ours, and of at most `most_nodes` elements and
/// attributes. `beginning`: how the first element of such a file begins, for hints ("<System ...>").
std::optional<Fault> first_fault(std::string_view text, std::string_view beginning,
                                 std::size_t most_nodes = std::size_t{1} << 20);

}  // namespace forage::xml
