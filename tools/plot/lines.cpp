#include "tools/plot/lines.h"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

constexpr double lines_left = 84, lines_top = 62, lines_width = 560, lines_height = 340, lines_bottom = 50;
constexpr std::size_t max_bars = 20;  // a line of more points has a band

Interval with_margin(Interval i, bool zero) {
    if (i.low > i.high) return {0, 1};
    if (zero && i.low > 0 && i.low < 0.6 * i.high) i.low = 0;
    const double margin = i.size() > 0 ? 0.05 * i.size() : 0.5;
    return {i.low == 0 && zero ? 0 : i.low - margin, i.high + margin};
}

void draw_interval(Canvas& canvas, const Axes& axes, const LinesPlot::Line& line, const Colour& colour) {
    if (line.points.size() <= max_bars) {
        for (const auto& p : line.points) {
            if (!p.y) continue;
            const double x = axes.px(p.x), low = axes.py(p.y->low), high = axes.py(p.y->high);
            canvas.line(x, low, x, high, colour, 1.4);
            for (const double y : {low, high}) canvas.line(x - 4, y, x + 4, y, colour, 1.4);
        }
        return;
    }
    cairo_t* c = canvas.cairo();
    for (auto from = line.points.begin(); from != line.points.end(); ++from) {  // a band up to each gap
        const auto gap = std::find_if(from, line.points.end(), [](const auto& p) { return !p.y; });
        for (auto p = from; p != gap; ++p) cairo_line_to(c, axes.px(p->x), axes.py(p->y->high));
        for (auto p = gap; p != from; --p) cairo_line_to(c, axes.px((p - 1)->x), axes.py((p - 1)->y->low));
        cairo_close_path(c);
        canvas.fill(colour, 0.2);
        if ((from = gap) == line.points.end()) break;
    }
}

void draw_line(Canvas& canvas, const Axes& axes, const LinesPlot::Line& line, std::optional<double> gap,
               const Colour& colour) {
    cairo_t* c = canvas.cairo();
    bool pen_down = false;
    double before = 0;
    for (const auto& p : line.points) {
        if (gap && p.x > *gap) pen_down = pen_down && before > *gap;
        before = p.x;
        if (p.y) (pen_down ? cairo_line_to : cairo_move_to)(c, axes.px(p.x), axes.py(p.y->mean));
        pen_down = p.y.has_value();
    }
    canvas.stroke(colour, 1.8);
    if (line.points.size() > max_bars) return;
    for (const auto& p : line.points) {
        if (!p.y) continue;
        canvas.circle(axes.px(p.x), axes.py(p.y->mean), 3.4);
        canvas.fill(colour);
    }
}

void draw_cross(Canvas& canvas, double x, double y, const Colour& colour) {
    canvas.line(x - 3.5, y - 3.5, x + 3.5, y + 3.5, colour, 1.6);
    canvas.line(x - 3.5, y + 3.5, x + 3.5, y - 3.5, colour, 1.6);
}

/// Two strokes across the x axis, with nothing between them.
void draw_break(Canvas& canvas, const Axes& axes, double at) {
    const double x = axes.px(at), y = axes.box.bottom();
    canvas.line(x - 3, y, x + 3, y, white, 4);
    for (const double side : {-3.0, 3.0}) canvas.line(x + side - 3, y + 6, x + side + 3, y - 6, black);
}

bool has_numbers(const LinesPlot::Line& line) {
    return std::ranges::any_of(line.points, [](const auto& p) { return p.y.has_value(); });
}

/// Crosses on the axis where a line has no number, one above the other when several lines have none, and the
/// numbers of runs beside points of fewer runs than `most`.
void draw_missing(Canvas& canvas, const Axes& axes, const LinesPlot& plot, std::size_t most) {
    std::map<double, int> crosses;
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        const auto& line = plot.lines[i];
        if (!has_numbers(line) || line.points.size() > max_bars) continue;
        for (const auto& p : line.points)
            if (!p.y)
                draw_cross(canvas, axes.px(p.x), axes.box.bottom() - 8 - 9 * crosses[p.x]++, category(i));
            else if (p.y->count < most)
                canvas.text(axes.px(p.x) + 7, axes.py(p.y->mean) - 6, fmt::format("n = {}", p.y->count), 10,
                            0, category(i));
    }
}

}  // namespace

Picture lines_plot(const LinesPlot& plot) {
    constexpr double far = std::numeric_limits<double>::max();
    Interval x{far, -far}, y{far, -far};
    std::size_t most = 0;
    bool missing = false;
    std::vector<std::string> names;
    for (const auto& line : plot.lines) {
        const bool any = has_numbers(line);
        names.push_back(any ? line.name : line.name + ": no data");
        for (const auto& p : line.points) {
            x = {std::min(x.low, p.x), std::max(x.high, p.x)};
            if (p.y) y = {std::min(y.low, p.y->low), std::max(y.high, p.y->high)};
            if (p.y) most = std::max(most, p.y->count);
            missing = missing || (any && !p.y && line.points.size() <= max_bars);
        }
    }
    const bool legend = plot.lines.size() > 1;
    Measure measure;
    double wide = missing ? measure.canvas().width_of("no data", 12) : 0;
    for (const auto& name : names)
        if (legend) wide = std::max(wide, measure.canvas().width_of(name, 12));
    const Axes axes{
        {lines_left, lines_top, lines_width, lines_height}, with_margin(x, false), with_margin(y, true)};
    const double last =
        plot.x_ticks.empty() ? 0 : measure.canvas().width_of(plot.x_ticks.back().second, 12) / 2;
    const double right = std::max(wide > 0 ? 52 + wide : 24, last);
    const double tall = 10 + 20 * static_cast<double>(names.size() + 1);
    const double width = std::max(
        {lines_left + lines_width + right, width_of_titles(measure.canvas(), plot.title, plot.subtitle)});
    return {
        width, lines_top + std::max(lines_height + lines_bottom, legend ? tall : 0), [=](Canvas& canvas) {
            draw_titles(canvas, plot.title, plot.subtitle);
            for (std::size_t i = 0; i < plot.lines.size(); ++i)
                draw_interval(canvas, axes, plot.lines[i], category(i));
            for (std::size_t i = 0; i < plot.lines.size(); ++i)
                draw_line(canvas, axes, plot.lines[i], plot.x_gap, category(i));
            draw_missing(canvas, axes, plot, most);
            draw_axes(canvas, axes, {plot.x_title, plot.x_ticks.empty(), true, plot.x_ticks}, {plot.y_title});
            if (plot.x_gap) draw_break(canvas, axes, *plot.x_gap);
            double at = lines_top + 10;
            const double left = axes.box.right() + 14;
            for (std::size_t i = 0; legend && i < names.size(); ++i, at += 20) {
                const bool any = has_numbers(plot.lines[i]);
                if (any) canvas.line(left, at, left + 20, at, category(i), 2.5);
                canvas.text(left + 27, at + 4, names[i], 12, 0, any ? black : grey);
            }
            if (!missing) return;
            draw_cross(canvas, left + 10, at, grey);
            canvas.text(left + 27, at + 4, "no data", 12);
        }};
}

}  // namespace forage::plot
