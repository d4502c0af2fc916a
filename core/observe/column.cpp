#include "core/observe/column.h"

#include <array>
#include <tuple>

#include <fmt/format.h>

#include "core/base/separated.h"
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
    std::vector<std::string> known;
    for (int i = 0; i < std::ssize(connection.type.states); ++i) {
        known.push_back(connection.type.states[i].name);
        if (known.back() == state)
            return ColumnRef{0, i, {}, fmt::format("{}:{}", model::trim(connection.name), state), *found};
    }
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
        std::vector<std::string> names;
        if (found.empty())
            for (const auto& g : s.groups) names.push_back(g.path);
        for (const int g : found) names.push_back(s.groups[g].path);
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
    std::vector<std::string> known;
    for (std::size_t i = 0; i < type.states.size(); ++i) {
        known.push_back(type.states[i].name);
        if (known.back() == state) return ColumnRef{group, static_cast<int>(i), {}, prefix + known.back()};
    }
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        known.emplace_back(inputs[k]);
        if (inputs[k] == state) return ColumnRef{group, -1, static_cast<InputKind>(k), prefix + known.back()};
    }
    for (std::size_t k = 0; k < type.inputs.size(); ++k) {
        known.push_back(type.inputs[k]);
        if (known.back() == state)
            return ColumnRef{group, -1, static_cast<InputKind>(input_kinds + k), prefix + known.back()};
    }
    context.error(piece.at + static_cast<std::size_t>(state.data() - text.data()),
                  fmt::format("{} has no state '{}'", type.name, state), suggest(state, known));
    return std::nullopt;
}

}  // namespace forage::observe
