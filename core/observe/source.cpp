#include "core/observe/source.h"

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/types/parameter.h"

namespace forage::observe {
namespace {

constexpr std::string_view mean_prefix = "mean:";

/// "3" or "3..5"
std::optional<std::pair<int, int>> parse_interval(std::string_view text) {
    const auto number = [](std::string_view t) -> std::optional<int> {
        const auto value = parse_parameter(ParameterKind::integer, model::trim(t));
        return value ? std::optional(std::get<int>(*value)) : std::nullopt;
    };
    const auto dots = text.find("..");
    const auto first = number(text.substr(0, dots));
    const auto last = dots == std::string_view::npos ? first : number(text.substr(dots + 2));
    if (!first || !last) return std::nullopt;
    return std::pair{*first, *last};
}

std::string interval(int first, int count) {
    return count == 1 ? fmt::format("{}", first) : fmt::format("{}..{}", first, first + count - 1);
}

}  // namespace

Selection parse_selection(std::string_view text) {
    Selection out;
    text = model::trim(text);
    if (text.starts_with(mean_prefix)) out.mean = true, text.remove_prefix(mean_prefix.size());
    out.column = text;
    const auto open = text.rfind('(');
    if (open == std::string_view::npos || !text.ends_with(')')) return out;
    const auto inside = text.substr(open + 1, text.size() - open - 2);
    const auto comma = inside.find(',');
    if (comma == std::string_view::npos) return out;
    const auto x = parse_interval(inside.substr(0, comma)), y = parse_interval(inside.substr(comma + 1));
    if (!x || !y) return out;  // a name may hold parentheses
    out.column = model::trim(text.substr(0, open));
    out.region = model::Region{x->first, y->first, x->second - x->first + 1, y->second - y->first + 1, {}};
    return out;
}

std::string Recorded::cell_name(std::size_t i) const {
    if (mean) return "mean";
    if (numbered) return fmt::format("cell{}", static_cast<std::size_t>(cells.x) + i);
    const int n = static_cast<int>(i);
    return fmt::format("x{}_y{}", cells.x + n % cells.width, cells.y + n / cells.width);
}

std::optional<Part> part_of(const Recorded& what, const Selection& selection) {
    Part out{{}, what};
    const model::Region& all = what.cells;
    if (what.mean && selection.region) return std::nullopt;
    const model::Region r = selection.region.value_or(all);
    if (!what.mean) {
        if (r.width < 1 || r.height < 1 || r.x < all.x || r.y < all.y || r.x + r.width > all.x + all.width ||
            r.y + r.height > all.y + all.height)
            return std::nullopt;
        out.what.cells = r;
        for (int y = r.y; y < r.y + r.height; ++y)
            for (int x = r.x; x < r.x + r.width; ++x)
                out.numbers.push_back(static_cast<std::size_t>((y - all.y) * all.width + x - all.x));
    } else {
        out.numbers = {0};
    }
    if (selection.region)
        out.what.name += fmt::format("({},{})", interval(r.x, r.width), interval(r.y, r.height));
    if (selection.mean && !what.mean) out.what.mean = true, out.what.name.insert(0, mean_prefix);
    return out;
}

void Part::take(std::span<const double> row, std::span<double> out) const {
    if (!what.mean || numbers.size() == 1) {
        for (std::size_t i = 0; i < numbers.size(); ++i) out[i] = row[numbers[i]];
        return;
    }
    double sum = 0;
    for (const std::size_t n : numbers) sum += row[n];
    out[0] = sum / static_cast<double>(numbers.size());
}

void Source::read(const engine::Simulation& simulation, std::span<double> out) const {
    const ConstColumn column = values(simulation, column_);
    part_.take({column.data(), static_cast<std::size_t>(column.size())}, out);
}

std::optional<Source> find_source(const engine::Layout& s, std::string_view text, std::string_view what,
                                  Diagnostics& diagnostics, Location at) {
    const Selection selection = parse_selection(text);
    if (const auto open = text.rfind('('); !selection.region && open != text.npos && text.ends_with(')')) {
        Diagnostics whole, part;  // a name may hold parentheses
        if (!find_column(s, selection.column, what, whole, at) &&
            find_column(s, parse_selection(text.substr(0, open)).column, what, part, at)) {
            diagnostics.error(at, fmt::format("{} '{}': '{}' names no cells", what, text, text.substr(open)),
                              "cells are written (x,y) or (x1..x2,y1..y2)");
            return std::nullopt;
        }
    }
    auto column = find_column(s, selection.column, what, diagnostics, at);
    if (!column) return std::nullopt;
    const auto& [path, id, shape, type] = s.groups[column->group];
    static constexpr std::string_view inputs[] = {"Excitation", "Inhibition", "Modulation"};

    Recorded whole;
    whole.name = column->name;
    whole.label = column->state >= 0 ? type.states[static_cast<std::size_t>(column->state)].label
                                     : std::string(inputs[static_cast<std::size_t>(column->kind)]);
    whole.group_id = id;
    whole.group = path.substr(path.find('/') + 1);
    if (const std::string suffix = "#" + whole.group_id; whole.group.ends_with(suffix))
        whole.group.resize(whole.group.size() - suffix.size());
    whole.state = column->name.substr(column->name.rfind(':') + 1);
    whole.numbered = shape.cells != shape.width * shape.height;
    whole.cells = {1, 1, whole.numbered ? shape.cells : shape.width, whole.numbered ? 1 : shape.height, {}};
    whole.group_width = whole.cells.width;

    auto part = part_of(whole, selection);
    if (!part) {
        diagnostics.error(
            at, fmt::format("{} '{}': '{}' has not all of these cells", what, text, path),
            whole.numbered
                ? fmt::format("it has {} cells without places: (1..{},1)", shape.cells, shape.cells)
                : fmt::format("it has {} columns and {} rows; cells count from (1, 1), at the upper left",
                              shape.width, shape.height));
        return std::nullopt;
    }
    Source out;
    out.column_ = std::move(*column);
    out.part_ = std::move(*part);
    return out;
}

}  // namespace forage::observe
