#include "tools/plot/heat.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tools/plot/axes.h"

namespace forage::plot {

Picture heat_map(const HeatMap& map) {
    const auto columns = static_cast<int>(map.x_names.size()), rows = static_cast<int>(map.y_names.size());
    Measure measure;
    double wide = 0, beside = 0;
    for (const auto& n : map.x_names) wide = std::max(wide, measure.canvas().width_of(n, 12));
    for (const auto& n : map.y_names) beside = std::max(beside, measure.canvas().width_of(n, 12));
    const double cell = std::clamp(std::max(560.0 / std::max(columns, rows), wide + 10), 12.0, 90.0);
    const double left = beside + 50, top = 62;
    const Box box{left, top, cell * columns, cell * rows};
    const Axes axes{box, {0.5, columns + 0.5}, {0.5, rows + 0.5}};
    ColourScale scale;
    for (const double v : map.numbers) scale.include(v);
    const auto ticks = [](const std::vector<std::string>& names) {
        std::vector<std::pair<double, std::string>> out;
        for (const auto& n : names) out.emplace_back(static_cast<double>(out.size() + 1), n);
        return out;
    };
    const double bar = std::max(box.height, 110.0);
    const double width = std::max({box.right() + 22 + 16 + colour_bar_labels,
                                   24 + measure.canvas().width_of(map.title, 15, true),
                                   24 + measure.canvas().width_of(map.subtitle, 12)});
    return {width, top + bar + 50, [=, x = ticks(map.x_names), y = ticks(map.y_names)](Canvas& canvas) {
                canvas.text(12, 22, map.title, 15, 0, black, true);
                canvas.text(12, 40, map.subtitle, 12, 0, grey);
                const auto at = [&](int column, int row) {
                    return map.numbers[static_cast<std::size_t>((rows - 1 - row) * columns + column)];
                };
                draw_cells(canvas, box, columns, rows, [&](int column, int row) {
                    return std::isnan(at(column, row)) ? pale : scale(at(column, row));
                });
                for (int row = 0; row < rows && cell >= 34; ++row)
                    for (int column = 0; column < columns; ++column) {
                        const double v = at(column, row);
                        const Colour c = std::isnan(v) ? pale : scale(v);
                        const bool dark = 0.3 * c.r + 0.59 * c.g + 0.11 * c.b < 0.5;
                        canvas.text(box.x + (column + 0.5) * cell, box.y + (row + 0.5) * cell + 4,
                                    std::isnan(v) ? "none" : fmt::format("{:.3g}", v), 12, 0.5,
                                    dark ? white : black);
                    }
                draw_axes(canvas, axes, {map.x_title, false, true, x}, {map.y_title, false, true, y});
                draw_colour_bar(canvas, scale, {box.right() + 22, top, 16, bar}, map.quantity);
            }};
}

}  // namespace forage::plot
