#include "core/observe/source.h"

#include <fmt/format.h>

namespace forage::observe {
namespace {

constexpr std::string_view mean_prefix = "mean:";

std::string interval(int first, int count) {
    return count == 1 ? fmt::format("{}", first) : fmt::format("{}..{}", first, first + count - 1);
}

}  // namespace

std::string Recorded::cell_name(std::size_t i) const {
    if (mean) return "mean";
    if (numbered) return fmt::format("cell{}", static_cast<std::size_t>(cells.x) + i);
    const int n = static_cast<int>(i);
    return fmt::format("x{}_y{}", cells.x + n % cells.width, cells.y + n / cells.width);
}

std::optional<Part> part_of(const Recorded& what, const expression::Source& source) {
    Part out{{}, what};
    const model::Region& all = what.cells;
    if (what.mean && source.cells) return std::nullopt;
    const model::Region r = source.cells.value_or(all);
    if (!what.mean) {
        const auto within = [](int first, int count, int all_first, int all_count) {
            return count >= 1 && first >= all_first && count <= all_count &&
                   first - all_first <= all_count - count;
        };
        if (!within(r.x, r.width, all.x, all.width) || !within(r.y, r.height, all.y, all.height))
            return std::nullopt;
        out.what.cells = r;
        for (int y = r.y; y < r.y + r.height; ++y)
            for (int x = r.x; x < r.x + r.width; ++x)
                out.numbers.push_back(static_cast<std::size_t>((y - all.y) * all.width + x - all.x));
    } else {
        out.numbers = {0};
    }
    if (source.cells)
        out.what.name += fmt::format("({},{})", interval(r.x, r.width), interval(r.y, r.height));
    if (source.mean && !what.mean) out.what.mean = true, out.what.name.insert(0, mean_prefix);
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
    const ConstColumn all = values(simulation, column);
    part.take({all.data(), static_cast<std::size_t>(all.size())}, out);
}

std::optional<Part> find_part(const engine::Layout& layout, const ColumnRef& column,
                              const expression::Source& source, const expression::Context& context) {
    const auto& [path, id, shape, type] = layout.groups[column.group];
    static constexpr std::string_view inputs[] = {"Excitation", "Inhibition", "Modulation"};

    Recorded whole;
    whole.name = column.name;
    whole.label = column.state >= 0 ? type.states[static_cast<std::size_t>(column.state)].label
                                    : std::string(inputs[static_cast<std::size_t>(column.kind)]);
    whole.group_id = id;
    whole.group = path.substr(path.find('/') + 1);
    if (const std::string suffix = "#" + whole.group_id; whole.group.ends_with(suffix))
        whole.group.resize(whole.group.size() - suffix.size());
    whole.state = column.name.substr(column.name.rfind(':') + 1);
    whole.numbered = shape.cells != shape.width * shape.height;
    whole.cells = {1, 1, whole.numbered ? shape.cells : shape.width, whole.numbered ? 1 : shape.height, {}};
    whole.group_width = whole.cells.width;

    auto part = part_of(whole, source);
    if (!part) {
        const bool one = source.cells_text.find("..") == std::string::npos;
        context.error(
            source.cells_at,
            fmt::format("'{}' has {} {}", path, one ? "no cell" : "not all of the cells", source.cells_text),
            whole.numbered
                ? fmt::format("it has {} cells without places: (1..{},1)", shape.cells, shape.cells)
                : fmt::format("it has {} columns and {} rows; cells count from (1, 1), at the upper left",
                              shape.width, shape.height));
    }
    return part;
}

std::optional<Source> find_source(const engine::Layout& layout, const expression::Source& source,
                                  const expression::Context& context) {
    auto column = find_column(layout, source.column, context);
    auto part = column ? find_part(layout, *column, source, context) : std::nullopt;
    if (!part) return std::nullopt;
    return Source{std::move(*column), std::move(*part)};
}

std::optional<Source> find_source(const engine::Layout& layout, std::string_view text, std::string_view what,
                                  Diagnostics& diagnostics, Location at) {
    const expression::Context context{text, what, diagnostics, std::move(at)};
    const auto source = context.parsed(&expression::parse_source);
    return source ? find_source(layout, *source, context) : std::nullopt;
}

}  // namespace forage::observe
