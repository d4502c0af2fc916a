#include "core/observe/source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/model/lookup.h"

namespace forage::observe {
namespace {

constexpr double max_synapses_recorded = 1 << 24;  ///< numbers in a row that recordings are read with

std::string interval(int first, int count) {
    return count == 1 ? fmt::format("{}", first) : fmt::format("{}..{}", first, first + count - 1);
}

}  // namespace

std::string Recorded::cell_name(std::size_t i) const {
    if (one_number()) return std::string(reduction);
    if (numbered) return fmt::format("cell{}", static_cast<std::size_t>(cells.x) + i);
    const int n = static_cast<int>(i);
    return fmt::format("x{}_y{}", cells.x + n % cells.width, cells.y + n / cells.width);
}

std::vector<std::string> Recorded::titles() const {
    if (one_number()) return {std::string(reduction)};
    std::vector<std::string> out, places;
    std::map<std::string, int> count;
    for (int i = 0; i < static_cast<int>(size()); ++i) {
        const int x = cells.x + i % cells.width, y = cells.y + i / cells.width;
        places.push_back(numbered ? fmt::format("cell {}", x) : fmt::format("({}, {})", x, y));
        ++count[out.emplace_back(numbered || synapses ? std::string() : names.of(x, y))];
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        if (out[i].empty())
            out[i] = places[i];
        else if (count[out[i]] > 1)
            out[i] += " " + places[i];
    return out;
}

namespace {

/// What a source selects of `what`: its cells, or one number of them. Empty when a cell is missing.
std::optional<Recorded> selected(const Recorded& what, const expression::Source& source) {
    Recorded out = what;
    if (what.one_number()) return source.cells ? std::nullopt : std::optional(out);
    const model::Region &all = what.cells, r = source.cells.value_or(all);
    const auto within = [](int first, int count, int all_first, int all_count) {
        return count >= 1 && first >= all_first && count <= all_count &&
               first - all_first <= all_count - count;
    };
    if (!within(r.x, r.width, all.x, all.width) || !within(r.y, r.height, all.y, all.height))
        return std::nullopt;
    out.cells = r;
    if (source.cells) {
        const auto text_of = [](const model::Region& some) {
            return fmt::format("({},{})", interval(some.x, some.width), interval(some.y, some.height));
        };
        // What was recorded of some cells is named by them.
        if (const auto own = text_of(all); out.name.ends_with(own))
            out.name.resize(out.name.size() - own.size());
        out.name += text_of(r);
    }
    if (!source.reduction.empty())
        out.reduction = source.reduction, out.name.insert(0, std::string(source.reduction) + ":");
    return out;
}

}  // namespace

std::optional<Part> part_of(const Recorded& what, const expression::Source& source) {
    auto found = selected(what, source);
    if (!found) return std::nullopt;
    Part out{{}, std::move(*found)};
    const model::Region &all = what.cells, &r = out.what.cells;
    if (what.one_number()) return out.numbers = {0}, out;
    for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x)
            out.numbers.push_back(static_cast<std::size_t>((y - all.y) * all.width + x - all.x));
    return out;
}

namespace {

/// The mean or the maximum of numbers; NaN when one of them is NaN, or there is none.
class Reduced {
  public:
    explicit Reduced(std::string_view reduction) : mean_(reduction == "mean") {}
    void add(double v) {
        ++count_;
        if (mean_)
            number_ += v;
        else if (count_ == 1 || v > number_ || std::isnan(v))
            number_ = v;
    }
    double number() const { return mean_ || count_ == 0 ? number_ / static_cast<double>(count_) : number_; }

  private:
    bool mean_;
    double number_ = 0;
    std::size_t count_ = 0;
};

}  // namespace

void Part::take(std::span<const double> row, std::span<double> out) const {
    // Most parts are one piece of the row: then nothing is looked up.
    const bool one_piece = numbers.back() - numbers.front() + 1 == numbers.size();
    const auto each = [&](auto visit) {
        if (one_piece)
            for (const double v : row.subspan(numbers.front(), numbers.size())) visit(v);
        else
            for (const std::size_t n : numbers) visit(row[n]);
    };
    if (what.one_number() && numbers.size() > 1) {
        Reduced reduced(what.reduction);
        each([&](double v) { reduced.add(v); });
        out[0] = reduced.number();
    } else {
        each([to = out.begin()](double v) mutable { *to++ = v; });
    }
}

namespace {

/// Calls visit(column, row, number) for each synapse in a range of the matrix; both count from 0 within it.
template <class Visit>
void for_each_synapse(const engine::Simulation& simulation, const ColumnRef& c, const model::Region& range,
                      Visit visit) {
    const auto pre = simulation.synapse_sources(c.connection),
               post = simulation.synapse_targets(c.connection);
    const ConstColumn numbers = simulation.synapse_state(c.connection, c.state);
    for (std::size_t i = 0; i < pre.size(); ++i) {
        const int x = pre[i] + 1 - range.x, y = post[i] + 1 - range.y;
        if (x >= 0 && x < range.width && y >= 0 && y < range.height)
            visit(x, y, numbers[static_cast<Index>(i)]);
    }
}

}  // namespace

std::vector<double> Source::all(const engine::Simulation& simulation) const {
    std::vector<double> out;
    if (column.connection >= 0) {
        for_each_synapse(simulation, column, what().cells, [&](int, int, double v) { out.push_back(v); });
    } else {
        const ConstColumn cells = values(simulation, column);
        for (const std::size_t i : part.numbers) out.push_back(cells[static_cast<Index>(i)]);
    }
    return out;
}

void Source::read(const engine::Simulation& simulation, std::span<double> out) const {
    if (column.connection >= 0) {
        if (what().one_number()) {
            Reduced reduced(what().reduction);
            for (const double v : all(simulation)) reduced.add(v);
            out[0] = reduced.number();
            return;
        }
        std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
        for_each_synapse(simulation, column, what().cells, [&](int x, int y, double v) {
            double& place = out[static_cast<std::size_t>(y) * static_cast<std::size_t>(what().cells.width) +
                                static_cast<std::size_t>(x)];
            place = std::isnan(place) ? v : place + v;
        });
        return;
    }
    const ConstColumn all = values(simulation, column);
    part.take({all.data(), static_cast<std::size_t>(all.size())}, out);
}

namespace {

/// The part of a connection's matrix that holds the synapses of `source`. Reports cells outside the groups.
std::optional<Part> find_synapse_part(const engine::Layout& layout, const ColumnRef& column,
                                      const expression::Source& source, const expression::Context& context) {
    const auto& connection = layout.connections[column.connection];
    const int sources = layout.groups[connection.source].shape.cells,
              targets = layout.groups[connection.target].shape.cells;
    const auto& state = connection.type.states[column.state];
    Recorded whole;
    whole.name = column.name, whole.label = state.label, whole.state = state.name;
    whole.group_id = connection.id, whole.group = model::trim(connection.name);
    whole.cells = {1, 1, sources, targets, {}}, whole.group_width = sources, whole.synapses = true;
    auto out = selected(whole, source);
    if (!out) {
        context.error(source.cells_at, fmt::format("'{}' has no synapses {}", column.name, source.cells_text),
                      fmt::format("a synapse is (source cell, target cell), of {} and {} cells, which count "
                                  "from 1, row by row",
                                  sources, targets));
        return std::nullopt;
    }
    if (const double numbers = double{1} * out->cells.width * out->cells.height;
        !out->one_number() && numbers > max_synapses_recorded) {
        context.error(
            source.column.at,
            fmt::format("'{}' is a matrix of {:.0f} numbers per cycle", column.name, numbers),
            fmt::format("choose source and target cells, '{0}(1..100,1..100)', or mean({0})", column.name));
        return std::nullopt;
    }
    return Part{{}, std::move(*out)};
}

}  // namespace

std::optional<Part> find_part(const engine::Layout& layout, const ColumnRef& column,
                              const expression::Source& source, const expression::Context& context) {
    const auto& [path, id, shape, type, names] = layout.groups[column.group];
    static constexpr std::string_view inputs[] = {"Excitation", "Inhibition", "Modulation"};

    const auto kind = static_cast<std::size_t>(column.kind);
    Recorded whole;
    whole.name = column.name;
    whole.label = column.state >= 0    ? type.states[static_cast<std::size_t>(column.state)].label
                  : kind < input_kinds ? std::string(inputs[kind])
                                       : type.inputs[kind - input_kinds];
    whole.group_id = id;
    whole.group = path.substr(path.find('/') + 1);
    if (const std::string suffix = "#" + whole.group_id; whole.group.ends_with(suffix))
        whole.group.resize(whole.group.size() - suffix.size());
    whole.state = column.name.substr(column.name.rfind(':') + 1);
    whole.numbered = shape.cells != shape.width * shape.height;
    whole.cells = {1, 1, whole.numbered ? shape.cells : shape.width, whole.numbered ? 1 : shape.height, {}};
    whole.group_width = whole.cells.width, whole.names = names;

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
    if (names_connection(layout, source.column)) {
        auto synapses = find_synapses(layout, source.column, context);
        auto part = synapses ? find_synapse_part(layout, *synapses, source, context) : std::nullopt;
        if (!part) return std::nullopt;
        return Source{std::move(*synapses), std::move(*part)};
    }
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
