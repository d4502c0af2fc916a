#include "core/observe/column.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/find_one.h"
#include "core/model/lookup.h"

namespace forage::observe {
namespace {

constexpr std::array<std::string_view, input_kinds> inputs = {"excIn", "inhIn", "modIn"};

/// Splits "Name:state" at its last colon. Without one, the state is empty.
std::pair<std::string_view, std::string_view> split_state(std::string_view text) {
    const auto colon = text.rfind(':');
    if (colon == std::string_view::npos) return {text, {}};
    return {text.substr(0, colon), model::trim(text.substr(colon + 1))};
}

}  // namespace

bool names_connection(const engine::Layout& s, const expression::Piece& piece) {
    const std::string_view text = piece.text, name = split_state(text).first;
    return model::groups_named(s.groups, text).empty() && model::groups_named(s.groups, name).empty() &&
           !(model::items_named(s.connections, name).empty() &&
             model::items_named(s.connections, text).empty());
}

std::optional<ColumnRef> find_synapses(const engine::Layout& s, const expression::Piece& piece,
                                       const expression::Context& context) {
    auto [name, state] = split_state(piece.text);
    if (model::items_named(s.connections, name).empty()) name = piece.text, state = {};
    const auto found = model::find_one(
        s.connections, "connection", name,
        [&](const std::string& message, const std::string& hint) { context.error(piece.at, message, hint); });
    if (!found) return std::nullopt;
    const auto& connection = s.connections[*found];
    if (connection.type.has_gain) {
        context.error(piece.at, fmt::format("the synapses of connection '{}' keep nothing", name),
                      fmt::format("{} has a fixed weight, the same in all synapses", connection.type.name));
        return std::nullopt;
    }
    const auto known = names_of(connection.type.states);
    if (const int i = static_cast<int>(std::ranges::find(known, state) - known.begin());
        i < std::ssize(known))
        return ColumnRef{0, i, {}, fmt::format("{}:{}", model::trim(connection.name), state), *found};
    context.error(
        piece.at,
        state.empty() ? fmt::format("'{}' names a connection, not a group", name)
                      : fmt::format("{} has no state '{}'", connection.type.name, state),
        fmt::format("its synapses have '{1}:{0}'", separated(known, fmt::format("', '{}:", name)), name));
    return std::nullopt;
}

std::optional<ColumnRef> find_column(const engine::Layout& s, std::string_view text, std::string_view what,
                                     Diagnostics& diagnostics, Location at) {
    return find_column(s, {std::string(text), 0}, {text, what, diagnostics, std::move(at)});
}

std::optional<ColumnRef> find_column(const engine::Layout& s, const expression::Piece& piece,
                                     const expression::Context& context) {
    const std::string_view text = piece.text;
    std::string_view path = text, state;
    auto found = model::groups_named(s.groups, path);  // a name may contain ':'
    if (found.empty()) std::tie(path, state) = split_state(text), found = model::groups_named(s.groups, path);
    if (found.size() != 1) {
        if (const auto open = text.rfind('('); found.empty() && text.ends_with(')') && open != text.npos) {
            // A name may contain parentheses. Here only the rest of the text names a group.
            const auto names_group = [&](std::string_view part) {
                return !model::groups_named(s.groups, part).empty();
            };
            const auto before = text.substr(0, open), inside = text.substr(open + 1, text.size() - open - 2);
            if (names_group(before) || names_group(before.substr(0, before.rfind(':')))) {
                context.error(piece.at + open, fmt::format("'{}' does not name cells", text.substr(open)),
                              "cells are written (x,y) or (x1..x2,y1..y2)");
                return std::nullopt;
            }
            if (names_group(inside) || names_group(inside.substr(0, inside.rfind(':')))) {
                context.error(piece.at, fmt::format("'{}' is not a function of cells here", before),
                              "sources have mean(...) and max(...), conditions also sum and min");
                return std::nullopt;
            }
        }
        auto names = collected(found, [&](int g) { return s.groups[g].path; });
        if (found.empty()) names = collected(s.groups, &engine::Layout::Group::path);
        context.error(piece.at,
                      found.empty() ? fmt::format("there is no group '{}'", path)
                                    : fmt::format("'{}' names {} groups", path, found.size()),
                      found.empty() ? model::suggest_group(path, names)
                                    : fmt::format("use one of '{}'", separated(names, "', '")));
        return std::nullopt;
    }
    const int group = found.front();
    const NeuronType& type = s.groups[group].type;
    const std::string prefix = s.groups[group].path + ":";
    if (state.empty()) return ColumnRef{group, type.output(), {}, prefix + type.states[type.output()].name};
    auto known = names_of(type.states);
    for (const auto name : inputs) known.emplace_back(name);
    known.insert(known.end(), type.inputs.begin(), type.inputs.end());
    const auto at = std::ranges::find(known, state) - known.begin(), states = std::ssize(type.states);
    if (at < states) return ColumnRef{group, static_cast<int>(at), {}, prefix + known[at]};
    if (at < std::ssize(known))
        return ColumnRef{group, -1, static_cast<InputKind>(at - states), prefix + known[at]};
    context.error(piece.at + static_cast<std::size_t>(state.data() - text.data()),
                  fmt::format("{} has no state '{}'", type.name, state), suggest(state, known));
    return std::nullopt;
}

}  // namespace forage::observe
