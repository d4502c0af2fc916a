// The one item that users name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/diagnostic.h"
#include "core/base/separated.h"
#include "core/model/names.h"

namespace forage::model {

/// The position of the item, a process or connection as `kind` says, that `name` names. When none or several
/// have it, calls report(message, hint) and returns nothing.
template <class Items, class Report>
std::optional<int> find_one(const Items& items, std::string_view kind, std::string_view name, Report report) {
    const auto found = items_named(items, name);
    if (found.size() == 1) return found.front();
    std::vector<std::string> names, ids;
    for (const auto& item : items) names.emplace_back(trim(item.name));
    for (const int i : found) ids.push_back(items[static_cast<std::size_t>(i)].id);
    if (found.empty())
        report(fmt::format("there is no {} '{}'", kind, name), suggest(name, names));
    else
        report(fmt::format("'{}' names {} {}{}", name, found.size(), kind, kind.ends_with('s') ? "es" : "s"),
               fmt::format("use the id: '{}'", separated(ids, "', '")));
    return std::nullopt;
}

}  // namespace forage::model
