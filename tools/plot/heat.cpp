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
    // Up to 40 values stand side by side with their names; of more, some have names.
    const int max_values = std::max(columns, rows);
    const double cell = max_values > 40 ? std::max(1000.0 / max_values, 1.0)
                                        : std::clamp(std::max(560.0 / max_values, wide + 10), 12.0, 90.0);
    const double top = 62, title = measure.canvas().width_of(map.x_title, 13);
    const double left = std::max(beside + 50, 12 + (title - cell * columns) / 2);
    const Box box{left, top, cell * columns, cell * rows};
    const Axes axes{box, {0.5, columns + 0.5}, {0.5, rows + 0.5}};
    ColourScale scale;
    std::size_t most = 0;
    for (const auto& e : map.cells)
        if (e) scale.include(e->mean), most = std::max(most, e->count);
    const auto ticks = [&](const std::vector<std::string>& names, double size) {
        const auto step = max_values > 40 ? static_cast<std::size_t>(std::ceil(size / cell)) : 1;
        std::vector<std::pair<double, std::string>> out;
        for (std::size_t i = 0; i < names.size(); i += step)
            out.emplace_back(static_cast<double>(i + 1), names[i]);
        return out;
    };
    const double bar = std::max(box.height, 110.0);
    const double width =
        std::max({box.right() + 22 + 16 + colour_bar_labels, box.x + (box.width + title) / 2 + 12,
                  width_of_titles(measure.canvas(), map.title, map.subtitle)});
    return {width, top + bar + 50,
            [=, x_ticks = ticks(map.x_names, wide + 10), y_ticks = ticks(map.y_names, 16)](Canvas& canvas) {
                draw_titles(canvas, map.title, map.subtitle);
                const auto at = [&](int column, int row) -> const auto& {
                    return map.cells[static_cast<std::size_t>((rows - 1 - row) * columns + column)];
                };
                draw_cells(canvas, box, columns, rows, [&](int column, int row) {
                    const auto& e = at(column, row);
                    return e ? scale(e->mean) : pale;
                });
                for (int row = 0; row < rows; ++row)
                    for (int column = 0; column < columns; ++column) {
                        const auto& e = at(column, row);
                        const double x = box.x + column * cell, y = box.y + row * cell;
                        if (!e) {
                            canvas.line(x, y, x + cell, y + cell, grey);
                            canvas.line(x, y + cell, x + cell, y, grey);
                        }
                        if (!e || cell < 34) continue;
                        const Colour c = scale(e->mean);
                        const bool dark = 0.3 * c.r + 0.59 * c.g + 0.11 * c.b < 0.5, few = e->count < most;
                        canvas.text(x + cell / 2, y + cell / 2 + (few ? -1 : 4),
                                    fmt::format("{:.3g}", e->mean), 12, 0.5, dark ? white : black);
                        if (few)
                            canvas.text(x + cell / 2, y + cell / 2 + 12, fmt::format("n = {}", e->count), 9,
                                        0.5, dark ? white : black);
                    }
                draw_axes(canvas, axes, {map.x_title, false, true, x_ticks},
                          {canvas.fitted(map.y_title, 13, bar + 40), false, true, y_ticks});
                draw_colour_bar(canvas, scale, {box.right() + 22, top, 16, bar}, map.quantity);
            }};
}

}  // namespace forage::plot
