#include "tools/plot/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

constexpr double lines_left = 84, lines_top = 62, lines_width = 560, lines_height = 340, lines_bottom = 50;
constexpr std::size_t most_bars = 20;  ///< a line of more points has a band

/// The 97.5 % quantile of Student's t distribution.
double student(std::size_t degrees) {
    static constexpr std::array table = {12.706, 4.303, 3.182, 2.776, 2.571,
                                         2.447,  2.365, 2.306, 2.262, 2.228};
    if (degrees <= table.size()) return table[degrees - 1];
    // The first terms of its expansion around the normal quantile (Abramowitz and Stegun, 26.7.5); exact to 3
    // digits.
    constexpr double z = 1.959964, z3 = z * z * z;
    const double n = static_cast<double>(degrees);
    return z + (z3 + z) / (4 * n) + (5 * z3 * z * z + 16 * z3 + 3 * z) / (96 * n * n);
}

Interval with_margin(Interval i, bool zero) {
    if (i.low > i.high) return {0, 1};
    if (zero && i.low > 0 && i.low < 0.6 * i.high) i.low = 0;
    const double margin = i.size() > 0 ? 0.05 * i.size() : 0.5;
    return {i.low == 0 && zero ? 0 : i.low - margin, i.high + margin};
}

void draw_interval(Canvas& canvas, const Axes& axes, const LinesPlot::Line& line, const Colour& colour) {
    cairo_t* c = canvas.cairo();
    if (line.points.size() <= most_bars) {
        for (const auto& p : line.points) {
            const double x = axes.px(p.x), low = axes.py(p.y.low), high = axes.py(p.y.high);
            canvas.line(x, low, x, high, colour, 1.4);
            for (const double y : {low, high}) canvas.line(x - 4, y, x + 4, y, colour, 1.4);
        }
        return;
    }
    for (const auto& p : line.points) cairo_line_to(c, axes.px(p.x), axes.py(p.y.high));
    for (auto p = line.points.rbegin(); p != line.points.rend(); ++p)
        cairo_line_to(c, axes.px(p->x), axes.py(p->y.low));
    cairo_close_path(c);
    canvas.colour(colour, 0.2);
    cairo_fill(c);
}

void draw_line(Canvas& canvas, const Axes& axes, const LinesPlot::Line& line, const Colour& colour) {
    cairo_t* c = canvas.cairo();
    canvas.colour(colour);
    cairo_set_line_width(c, 1.8);
    for (const auto& p : line.points) cairo_line_to(c, axes.px(p.x), axes.py(p.y.mean));
    cairo_stroke(c);
    if (line.points.size() > most_bars) return;
    for (const auto& p : line.points) {
        cairo_arc(c, axes.px(p.x), axes.py(p.y.mean), 3.4, 0, 2 * M_PI);
        cairo_fill(c);
    }
}

}  // namespace

std::optional<Estimate> estimate(const std::vector<double>& numbers) {
    if (numbers.empty()) return std::nullopt;
    const auto n = static_cast<double>(numbers.size());
    double mean = 0, squares = 0;
    for (const double v : numbers) mean += v / n;
    for (const double v : numbers) squares += (v - mean) * (v - mean);
    if (numbers.size() == 1) return Estimate{mean, mean, mean};
    const double half = student(numbers.size() - 1) * std::sqrt(squares / (n - 1) / n);
    return Estimate{mean, mean - half, mean + half};
}

Picture lines_plot(const LinesPlot& plot) {
    constexpr double most = std::numeric_limits<double>::max();
    Interval x{most, -most}, y{most, -most};
    Measure measure;
    double names = 0;
    for (const auto& line : plot.lines) {
        names = std::max(names, measure.canvas().width_of(line.name, 12));
        for (const auto& p : line.points) {
            x = {std::min(x.low, p.x), std::max(x.high, p.x)};
            y = {std::min(y.low, p.y.low), std::max(y.high, p.y.high)};
        }
    }
    const Axes axes{
        {lines_left, lines_top, lines_width, lines_height}, with_margin(x, false), with_margin(y, true)};
    const double last =
        plot.x_ticks.empty() ? 0 : measure.canvas().width_of(plot.x_ticks.back().second, 12) / 2;
    const double right = std::max(plot.lines.size() > 1 ? 52 + names : 24, last);
    const double width =
        std::max({lines_left + lines_width + right, 24 + measure.canvas().width_of(plot.title, 15, true),
                  24 + measure.canvas().width_of(plot.subtitle, 12)});
    return {width, lines_top + lines_height + lines_bottom, [=](Canvas& canvas) {
                canvas.text(12, 22, plot.title, 15, 0, black, true);
                canvas.text(12, 40, plot.subtitle, 12, 0, grey);
                for (std::size_t i = 0; i < plot.lines.size(); ++i)
                    draw_interval(canvas, axes, plot.lines[i], category(i));
                for (std::size_t i = 0; i < plot.lines.size(); ++i)
                    draw_line(canvas, axes, plot.lines[i], category(i));
                draw_axes(canvas, axes, {plot.x_title, false, true, plot.x_ticks}, {plot.y_title});
                double at = lines_top + 10;
                for (std::size_t i = 0; plot.lines.size() > 1 && i < plot.lines.size(); ++i, at += 20) {
                    canvas.line(axes.box.right() + 14, at, axes.box.right() + 34, at, category(i), 2.5);
                    canvas.text(axes.box.right() + 41, at + 4, plot.lines[i].name, 12);
                }
            }};
}

}  // namespace forage::plot
