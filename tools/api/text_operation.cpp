#include "tools/api/text_operation.h"

#include <algorithm>

#include "core/xml/patch.h"

namespace forage::editing {

nlohmann::json text_operation(const std::string& before, const std::string& after) {
    const auto shorter = static_cast<std::ptrdiff_t>(std::min(before.size(), after.size()));
    const auto begin =
        std::mismatch(before.begin(), before.begin() + shorter, after.begin()).first - before.begin();
    const auto same_end =
        std::mismatch(before.rbegin(), before.rbegin() + shorter - begin, after.rbegin()).first -
        before.rbegin();
    const xml::Span part{static_cast<std::size_t>(begin), before.size() - static_cast<std::size_t>(same_end)};
    const auto root = xml::scan(before);
    // An element around them begins before them, and ends after them.
    const auto id = xml::item_around(root, {part.begin - std::min<std::size_t>(part.begin, 1), part.end + 1});
    const auto place = id.empty() || id == "system" ? std::nullopt : xml::find_item(root, id);
    // Another item with the same id may have been found.
    if (!place || part.begin <= place->begin || part.end >= place->end)
        return {{"do", "text"}, {"id", "system"}, {"text", after}};
    // What is before and after the part is the same in both texts.
    const std::size_t end = after.size() - (before.size() - place->end);
    return {{"do", "text"}, {"id", id}, {"text", after.substr(place->begin, end - place->begin)}};
}

}  // namespace forage::editing
