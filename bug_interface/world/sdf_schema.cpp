#include "bug_interface/world/sdf_schema.h"

#include <algorithm>

#include "bug_interface/world/sdf_rules.h"

namespace forage::bug {
namespace {

Content content(std::string_view kind) {
    switch (kind.empty() ? '\0' : kind.front()) {
        case 's':
            return Content::text;
        case 'b':
            return Content::truth;
        case '1':
            return Content::number;
        case 'i':
            return Content::whole_number;
        case '2':
            return Content::two_numbers;
        case '3':
            return Content::three_numbers;
        case 'c':
            return Content::colour;
        case 'p':
            return Content::pose;
        case '*':
            return Content::anything;
        default:
            return Content::elements;
    }
}

/// Calls visit(name, kind) for what may stand in `parent`, until it returns true.
template <class F>
void each_child(std::string_view parent, F visit) {
    const auto rule = std::ranges::lower_bound(rules, parent, {}, &Rule::parent);
    if (rule == std::end(rules) || rule->parent != parent) return;
    for (std::string_view rest = rule->children; !rest.empty();) {
        const std::string_view word = rest.substr(0, rest.find(' '));
        rest.remove_prefix(std::min(word.size() + 1, rest.size()));
        const auto colon = std::min(word.find(':'), word.size());
        if (visit(word.substr(0, colon), word.substr(std::min(colon + 1, word.size())))) return;
    }
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::optional<Content> content_of(std::string_view element, std::string_view parent) {
    std::optional<Content> out;
    each_child(parent, [&](std::string_view name, std::string_view kind) {
        if (name != element) return false;
        out = content(kind);
        return true;
    });
    return out;
}

std::vector<std::string> known_children(std::string_view parent) {
    std::vector<std::string> out;
    each_child(parent, [&](std::string_view name, std::string_view) {
        out.emplace_back(name);
        return false;
    });
    return out;
}

std::vector<std::string_view> required_attributes(std::string_view element) {
    if (is_one_of(element, {"joint", "light", "sensor"})) return {"name", "type"};
    if (is_one_of(element, {"collision", "link", "model", "visual", "world"})) return {"name"};
    if (element == "physics") return {"type"};
    if (element == "plugin") return {"name", "filename"};
    return {};
}

std::vector<std::string_view> required_children(std::string_view element) {
    if (element == "joint") return {"parent", "child"};
    if (element == "box") return {"size"};
    if (element == "cylinder") return {"radius", "length"};
    if (element == "sphere") return {"radius"};
    return {};
}

}  // namespace forage::bug
