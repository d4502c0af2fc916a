#include "tools/plot/wiring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

/// The sum of the strengths from each source cell to each target cell, NaN where there is no synapse.
std::vector<double> fields_of(const WiringPlot& p) {
    std::vector<double> out(
        static_cast<std::size_t>(p.source_shape.cells) * static_cast<std::size_t>(p.target_shape.cells),
        std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < p.pre.size(); ++i) {
        double& sum =
            out[static_cast<std::size_t>(p.post[i]) * static_cast<std::size_t>(p.source_shape.cells) +
                static_cast<std::size_t>(p.pre[i])];
        sum = std::isnan(sum) ? p.strength[i] : sum + p.strength[i];
    }
    return out;
}

/// Draws the source, with the cells that have a synapse in the colour of their strength.
void draw_field(Canvas& canvas, const WiringPlot& plot, std::span<const double> strengths,
                const ColourScale& scale, const Box& box, double cell) {
    const GroupShape& source = plot.source_shape;
    canvas.fill(box.x, box.y, box.width, box.height, {0.93, 0.93, 0.93});
    for (int y = 0; y < source.height; ++y)
        for (int x = 0; x < source.width; ++x) {
            const int pre = plot.source_places[static_cast<std::size_t>(y * source.width + x)];
            if (pre >= 0 && std::isnan(strengths[static_cast<std::size_t>(pre)])) continue;
            canvas.fill(box.x + x * cell, box.y + y * cell, cell, cell,
                        pre < 0 ? white : scale(strengths[static_cast<std::size_t>(pre)]));
        }
    // One path for all lines, as files grow with the number of paths.
    for (int x = 1; x < source.width; ++x)
        canvas.segment(box.x + x * cell, box.y, box.x + x * cell, box.bottom());
    for (int y = 1; y < source.height; ++y)
        canvas.segment(box.x, box.y + y * cell, box.right(), box.y + y * cell);
    canvas.stroke(white);
    draw_frame(canvas, box, grey);
}

Picture drawn_with(const ColourScale& scale, const WiringPlot& plot, std::vector<double> fields) {
    constexpr double left = 14, top = 76, bottom = 34, bar_gap = 20, bar_width = 14;  // pixels
    constexpr int max_pixels = 640, largest_cell = 22, smallest_cell = 3;
    constexpr double frame = 6;  // between two panels
    const GroupShape &source = plot.source_shape, &target = plot.target_shape;
    const auto side = [&](int panels, int cells) { return (max_pixels - panels * frame) / (panels * cells); };
    const double cell = std::min(std::floor(std::min(side(target.width, source.width),  //
                                                     side(target.height, source.height))),
                                 double(largest_cell));
    if (cell < smallest_cell)
        throw std::runtime_error(
            fmt::format("'{}' joins groups of {} x {} and {} x {} cells, which are too large for a wiring "
                        "plot; draw 'connection:{}'",
                        plot.title, source.width, source.height, target.width, target.height, plot.title));
    const double step_x = cell * source.width + frame, step_y = cell * source.height + frame;
    const double width = step_x * target.width, height = step_y * target.height;
    const std::string legend =
        fmt::format("each panel is a cell of {} and shows {}: coloured are the cells from which it receives",
                    plot.target, plot.source);
    return {
        std::max({left + width + bar_gap + bar_width + colour_bar_labels, 560.0,
                  24 + Measure().canvas().width_of(legend, 12)}),
        top + std::max(height, 110.0) + bottom, [=, fields = std::move(fields)](Canvas& canvas) {
            draw_titles(canvas, plot.title, plot.subtitle);
            canvas.text(12, 57, legend, 12, 0, grey);
            for (int row = 0; row < target.height; ++row)
                for (int column = 0; column < target.width; ++column) {
                    const int post =
                        plot.target_places[static_cast<std::size_t>(row * target.width + column)];
                    if (post < 0) continue;
                    const Box box{left + column * step_x, top + row * step_y, step_x - frame, step_y - frame};
                    draw_field(canvas, plot,
                               std::span(fields).subspan(
                                   static_cast<std::size_t>(post) * static_cast<std::size_t>(source.cells),
                                   static_cast<std::size_t>(source.cells)),
                               scale, box, cell);
                }
            draw_colour_bar(canvas, scale, {left + width + bar_gap, top, bar_width, std::max(height, 110.0)},
                            plot.quantity);
        }};
}

}  // namespace

Picture wiring_plot(const std::vector<WiringPlot>& plots) {
    std::vector<std::vector<double>> fields;
    ColourScale scale;
    for (const auto& p : plots) {
        fields.push_back(fields_of(p));
        for (const double v : fields.back()) scale.include(v);
    }
    std::vector<Picture> all;
    for (std::size_t i = 0; i < plots.size(); ++i)
        all.push_back(drawn_with(scale, plots[i], std::move(fields[i])));
    const double tall = all.front().height;
    return {all.front().width, tall * static_cast<double>(all.size()), [=](Canvas& canvas) {
                for (const auto& p : all) {
                    p.draw(canvas);
                    cairo_translate(canvas.cairo(), 0, tall);
                }
            }};
}

}  // namespace forage::plot
