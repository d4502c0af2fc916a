#include "core/observe/cell.h"

#include <fmt/format.h>

#include "core/model/lookup.h"

namespace forage::observe {

std::optional<Index> find_cell(const engine::Layout& layout, int group, int x, int y, std::string_view what,
                               Diagnostics& diagnostics, Location at) {
    const GroupShape shape = layout.groups[group].shape;
    const bool full = shape.cells == shape.width * shape.height;
    if (full && x >= 1 && y >= 1 && x <= shape.width && y <= shape.height)
        return Index{y - 1} * shape.width + x - 1;
    diagnostics.error(std::move(at),
                      fmt::format("{}: '{}' has no cell ({}, {})", what, layout.groups[group].path, x, y),
                      full ? fmt::format("it has {} columns and {} rows; cells count from (1, 1), at the "
                                         "upper left",
                                         shape.width, shape.height)
                           : "it is sparse: its cells are not numbered by column and row");
    return std::nullopt;
}

std::optional<std::pair<int, int>> parse_cell(std::string_view text) {
    const auto comma = text.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    const auto x = parse_parameter(ParameterKind::integer, model::trim(text.substr(0, comma)));
    const auto y = parse_parameter(ParameterKind::integer, model::trim(text.substr(comma + 1)));
    if (!x || !y) return std::nullopt;
    return std::pair(std::get<int>(*x), std::get<int>(*y));
}

}  // namespace forage::observe
