#include "tools/plot/space.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

ColourScale scale_of(const SpacePlot& plot) {
    ColourScale scale;
    for (const auto& f : plot.frames)
        for (const double v : f.values) scale.include(v);
    return scale;
}

/// The layout of the sheet, in pixels.
struct PanelSheet {
    static constexpr double top = 76, bar = 16, bar_gap = 22, bottom = 46;
    int across, down;
    double left = 66;
    double step_x, step_y, panel_width, panel_height, panels_width, panels_height, width, height;

    /// `names` is the width of the names of rows.
    PanelSheet(const CellGrid& grid, std::size_t frames, double names) {
        if (frames == 1) left += std::max(0.0, names - 20);
        const auto n = static_cast<int>(frames);
        const CellSize cell = n == 1 ? cell_size(grid.width, grid.height, 640, 480, 48, 20)
                                     : cell_size(grid.width, grid.height, 210, 170, 20, 20);
        panel_width = cell.width * grid.width;
        panel_height = cell.height * grid.height;
        step_x = n == 1 ? panel_width : std::max(panel_width + 46, 96.0);
        step_y = panel_height + (n == 1 ? 0 : 56);
        // The number of columns gives the sheet an aspect ratio of about 4 to 3.
        across = std::clamp(static_cast<int>(std::lround(std::sqrt(n * step_y / step_x * 4 / 3))), 1, n);
        down = (n + across - 1) / across;
        across = (n + down - 1) / down;
        panels_width = (across - 1) * step_x + panel_width;
        panels_height = (down - 1) * step_y + panel_height;
        width = left + panels_width + bar_gap + bar + colour_bar_labels;
        height = top + std::max(panels_height, 90.0) + bottom;
    }
    Box panel(std::size_t i) const {
        return {left + static_cast<int>(i) % across * step_x, top + static_cast<int>(i) / across * step_y,
                panel_width, panel_height};
    }
    Box colour_bar() const {
        return {left + panels_width + bar_gap, top, bar, std::clamp(panels_height, 90.0, 480.0)};
    }
};

/// The names of the columns while these are few, or what all columns are.
std::string name_across(const CellGrid& g) {
    constexpr int max_named = 9;
    if (g.synapses) return "source cell";
    if (g.numbered) return "cell";
    if (g.names.columns.empty() || g.width > max_named)
        return g.names.column.empty() ? "column of cells" : g.names.column;
    std::string out;
    for (int x = g.x; x < g.x + g.width && x <= std::ssize(g.names.columns); ++x)
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", x,
                           g.names.columns[static_cast<std::size_t>(x - 1)]);
    return out;
}
std::string name_down(const CellGrid& g) {
    if (g.synapses) return "target cell";
    return g.numbered ? "" : g.names.row.empty() ? "row" : g.names.row;
}

/// The numbers and names of the rows, for the ticks of a single panel.
std::vector<std::pair<double, std::string>> row_ticks(const CellGrid& g) {
    const auto& all = g.names.rows;
    if (g.synapses || g.numbered || std::ssize(all) < g.y - 1 + g.height) return {};
    return numbered_ticks({all.begin() + g.y - 1, all.begin() + g.y - 1 + g.height}, g.y);
}

void draw_panel(Canvas& canvas, const SpacePlot& plot, const SpaceFrame& frame, const ColourScale& scale,
                const Box& box, bool single) {
    const CellGrid& g = plot.grid;
    draw_cells(canvas, box, g.width, g.height, [&](int column, int row) {
        const double v = frame.values[static_cast<std::size_t>(row * g.width + column)];
        return std::isnan(v) ? Colour{0.93, 0.93, 0.93} : scale(v);  // there is no synapse
    });
    const auto divide = [&](int blocks, bool across) {
        for (int b = 1; b < blocks; ++b) {
            const double at = std::round((across ? box.width : box.height) * b / blocks);
            if (across)
                canvas.line(box.x + at, box.y, box.x + at, box.bottom(), white, 2);
            else
                canvas.line(box.x, box.y + at, box.right(), box.y + at, white, 2);
        }
    };
    divide(plot.blocks_across, true);
    divide(plot.blocks_down, false);
    const Axes axes{box, {g.x - 0.5, g.x + g.width - 0.5}, {g.y - 0.5, g.y + g.height - 0.5}, true};
    AxisStyle rows{single ? name_down(g) : "", true, !g.numbered};
    if (single) rows.ticks = row_ticks(g);
    draw_axes(canvas, axes, {"", true}, rows);
    if (!single) canvas.text(box.x + box.width / 2, box.y - 6, fmt::format("cycle {}", frame.cycle), 12, 0.5);
}

Picture sheet_of(const SpacePlot& plot, std::vector<SpaceFrame> frames, const ColourScale& scale) {
    Measure measure;
    double names = 0;
    for (const auto& [at, name] : row_ticks(plot.grid))
        names = std::max(names, measure.canvas().width_of(name, 12));
    const PanelSheet sheet(plot.grid, frames.size(), names);
    const std::string subtitle =
        frames.size() == 1 ? fmt::format("{}{}{}", moment_text(frames[0].cycle, plot.seconds_per_cycle),
                                         plot.subtitle.empty() ? "" : " · ", plot.subtitle)
                           : plot.subtitle;
    // A title that is wider than the panels stands below the colour bar, too.
    const double across = measure.canvas().width_of(name_across(plot.grid), 13);
    const double middle = std::max(sheet.left + sheet.panels_width / 2, 12 + across / 2);
    const double below =
        across > sheet.panels_width ? std::max(sheet.panels_height, 90.0) : sheet.panels_height;
    const double width = std::max({sheet.width, width_of_titles(measure.canvas(), plot.title, subtitle),
                                   260.0, middle + across / 2 + 12});
    return {width, sheet.height, [=](Canvas& canvas) {
                draw_titles(canvas, plot.title, subtitle);
                for (std::size_t i = 0; i < frames.size(); ++i)
                    draw_panel(canvas, plot, frames[i], scale, sheet.panel(i), frames.size() == 1);
                canvas.text(middle, sheet.top + below + 37, name_across(plot.grid), 13, 0.5);
                if (frames.size() > 1)
                    canvas.text_upwards(sheet.left - 40, sheet.top + sheet.panels_height / 2,
                                        name_down(plot.grid), 13);
                draw_colour_bar(canvas, scale, sheet.colour_bar(), plot.quantity);
            }};
}

}  // namespace

Picture space_plot(const SpacePlot& plot) { return sheet_of(plot, plot.frames, scale_of(plot)); }

std::vector<Picture> space_animation(const SpacePlot& plot) {
    const ColourScale scale = scale_of(plot);
    std::vector<Picture> out;
    double width = 0;
    for (const auto& f : plot.frames) {
        out.push_back(sheet_of(plot, {f}, scale));
        width = std::max(width, out.back().width);
    }
    for (auto& p : out) p.width = width;
    return out;
}

}  // namespace forage::plot
