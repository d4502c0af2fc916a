// Changes the text of a system file as its system was changed, and leaves everything else as its author wrote
// it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model/system.h"
#include "core/xml/source_tree.h"

namespace forage::xml {

/// How much of a text is replaced.
enum class Extent {
    least,  ///< attributes and elements that differ
    items,  ///< the groups and connections that differ
    all,    ///< everything
};

/// The text of a file of `before`, changed into a text of `after`. Attributes and elements that do not differ
/// keep their bytes: values as they are written, comments, blanks and order. What is new stands where the
/// writer would write it, with the indentation of its neighbours. A comment before a process, group or
/// connection goes with it.
std::string patched(const std::string& text, const model::System& before, const model::System& after,
                    Extent extent = Extent::least);

/// A text that was changed, and the system that is read from it.
struct Patch {
    std::string text;
    std::optional<model::System> system;  ///< empty when the text has mistakes that hide its meaning
    Diagnostics diagnostics;              ///< of the reader
    Extent extent = Extent::least;
};
/// patched() to the least extent whose text reads as `after`. `path` is the name of the file.
Patch patch(const std::string& path, const std::string& text, const model::System& before,
            const model::System& after, bool lenient = false);

/// Whether two systems have the same text, apart from comments and from elements that a file may leave out.
bool same_content(const model::System& a, const model::System& b);

/// The place of the element of the process, group, connection or comment with this id; of the outermost when
/// `id` is that of the system. Empty when there is none.
std::optional<Span> find_item(const SourceElement& root, std::string_view id);
/// The id of the innermost process, group or connection around a part of the text; empty when there is none.
std::string item_around(const SourceElement& root, Span part);

}  // namespace forage::xml
