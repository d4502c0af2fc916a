#include "tools/plot/connection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

constexpr int longest_side = 560;  ///< longest side of a table, in pixels and in bins
constexpr double no_synapse = std::numeric_limits<double>::quiet_NaN();

/// A matrix with a row per target cell and a column per source cell. In groups that are larger than the
/// picture, several cells share a bin, which has the value with the largest absolute value.
struct SynapseTable {
    int columns, rows;
    std::vector<double> numbers;

    double& at(int column, int row) {
        return numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    }
};

template <class Values, class Join>
SynapseTable table_of(const ConnectionPlot& p, const Values& values, Join join) {
    // Synapses between the same two cells are joined first, independently of the size of the groups.
    std::vector<std::size_t> order(p.pre.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return std::pair(p.post[a], p.pre[a]) < std::pair(p.post[b], p.pre[b]);
    });
    SynapseTable out{
        std::min(p.source_shape.cells, longest_side), std::min(p.target_shape.cells, longest_side), {}};
    out.numbers.assign(static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows),
                       no_synapse);
    for (std::size_t i = 0; i < order.size();) {
        const int pre = p.pre[order[i]], post = p.post[order[i]];
        double value = static_cast<double>(values[order[i]]);
        for (++i; i < order.size() && p.pre[order[i]] == pre && p.post[order[i]] == post; ++i)
            value = join(value, static_cast<double>(values[order[i]]));
        double& place =
            out.at(static_cast<int>(static_cast<long long>(pre) * out.columns / p.source_shape.cells),
                   static_cast<int>(static_cast<long long>(post) * out.rows / p.target_shape.cells));
        if (std::isnan(place) || std::abs(value) > std::abs(place)) place = value;
    }
    return out;
}

std::string cells_of(const std::string& name, const GroupShape& s) {
    return s.cells == s.width * s.height
               ? fmt::format("cell of {} ({} × {}, row by row)", name, s.width, s.height)
               : fmt::format("cell of {} ({})", name, s.cells);
}

}  // namespace

Picture connection_plot(const ConnectionPlot& plot) {
    constexpr double top = 66, bottom = 50, bar = 16;  // pixels around the tables
    struct Panel {
        SynapseTable table;
        ColourScale scale;
        std::string quantity;
    };
    std::vector<Panel> panels;
    panels.push_back(
        {table_of(plot, plot.strength, [](double a, double b) { return a + b; }), {}, "strength"});
    if (std::ranges::any_of(plot.delay, [](int d) { return d != 0; }))
        panels.push_back({table_of(plot, plot.delay, [](double a, double b) { return std::max(a, b); }),
                          {},
                          "delay (cycles)"});
    for (auto& p : panels)
        for (const double v : p.table.numbers) p.scale.include(v);
    const SynapseTable& t = panels[0].table;
    const CellSize cell = cell_size(t.columns, t.rows, longest_side, longest_side, 28, 60);
    const double width = cell.width * t.columns, height = cell.height * t.rows,
                 tall = std::max(height, 110.0);
    Measure measure;
    // The label below a narrow table is wider than the table, on both sides.
    const std::string below = measure.canvas().fitted(cells_of(plot.source, plot.source_shape), 13, 320);
    const double beside = std::max(0.0, (measure.canvas().width_of(below, 13) - width) / 2);
    const double left = std::max(78.0, beside + 12), gap = std::max(22.0, beside + 10);
    const double step = left + width + gap + bar + colour_bar_labels;
    const double room = std::max({step * static_cast<double>(panels.size()),
                                  width_of_titles(measure.canvas(), plot.title, plot.subtitle), 420.0});
    return {
        room, top + tall + bottom, [=](Canvas& canvas) {
            draw_titles(canvas, plot.title, plot.subtitle);
            double x = left;
            for (const auto& p : panels) {
                const Box box{x, top, width, height};
                SynapseTable table = p.table;
                draw_cells(canvas, box, table.columns, table.rows, [&](int column, int row) {
                    const double v = table.at(column, row);
                    return std::isnan(v) ? Colour{0.93, 0.93, 0.93} : p.scale(v);
                });
                const Axes axes{
                    box, {0.5, plot.source_shape.cells + 0.5}, {0.5, plot.target_shape.cells + 0.5}, true};
                draw_axes(canvas, axes, {below, true},
                          {canvas.fitted("cell of " + plot.target, 13, tall), true});
                draw_colour_bar(canvas, p.scale, {box.right() + gap, top, bar, tall}, p.quantity);
                x += step;
            }
        }};
}

}  // namespace forage::plot
