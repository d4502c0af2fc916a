// Resolves the names that users give groups, processes and connections: in assignments, sources, pictures and
// options.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace forage::model {

/// `text` without blanks at its ends.
std::string_view trim(std::string_view text);

/// The positions of the items that fit.
template <class Items, class Fits>
std::vector<int> positions(const Items& items, Fits fits) {
    std::vector<int> out;
    for (int i = 0; const auto& item : items) {
        if (fits(item)) out.push_back(i);
        ++i;
    }
    return out;
}

/// The positions of the items, processes or connections, that `wanted` names: the one with this id, or those
/// with this name.
template <class Items>
std::vector<int> items_named(const Items& items, std::string_view wanted) {
    wanted = trim(wanted);
    auto out = positions(items, [&](const auto& item) { return item.id == wanted; });
    return out.empty() ? positions(items, [&](const auto& item) { return trim(item.name) == wanted; }) : out;
}

/// `name`, or `name` with a number, so that none of the items has it.
template <class Items>
std::string free_name(const Items& items, const std::string& name) {
    const auto is_taken = [&](std::string_view wanted) {
        return std::ranges::any_of(items, [&](const auto& i) { return trim(i.name) == trim(wanted); });
    };
    std::string out = name;
    for (int n = 2; is_taken(out); ++n) out = std::string(trim(name)) + " " + std::to_string(n);
    return out;
}

/// The positions of the groups that `wanted` names. It is "Process/Group", "Process/Group#id", "#id" or an
/// id; the first of these that fits any group counts. The paths of the groups are those of group_paths().
template <class Groups>
std::vector<int> groups_named(const Groups& groups, std::string_view wanted) {
    wanted = trim(wanted);
    if (wanted.empty()) return {};
    const auto same_path = [](const auto& g, std::string_view path) {
        std::string_view own = g.path;
        if (own == path) return true;
        if (!own.ends_with(g.id)) return false;
        own.remove_suffix(g.id.size());
        return own.ends_with('#') && own.substr(0, own.size() - 1) == path;
    };
    auto out = positions(groups, [&](const auto& g) { return g.path == wanted; });
    if (out.empty()) out = positions(groups, [&](const auto& g) { return same_path(g, wanted); });
    if (const auto hash = wanted.rfind('#'); out.empty() && hash != wanted.npos) {
        const auto path = trim(wanted.substr(0, hash)), id = wanted.substr(hash + 1);
        out = positions(groups,
                        [&](const auto& g) { return g.id == id && (path.empty() || same_path(g, path)); });
    }
    return out.empty() ? positions(groups, [&](const auto& g) { return g.id == wanted; }) : out;
}

}  // namespace forage::model
