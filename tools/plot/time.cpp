#include "tools/plot/time.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace forage::plot {
namespace {

constexpr double time_left = 84, time_top = 62, time_bottom = 64,
                 time_width = 760;  ///< pixels around and across the curves
constexpr double name_room = 42;    ///< that names of rows have in `time_left`

Interval cycles_of(const TimePlot& plot) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const auto& c : plot.curves)
        if (!c.bins().empty()) {
            low = std::min(low, c.bins().front().first);
            high = std::max(high, c.bins().back().last);
        }
    if (low > high) return {0, 1};
    return high > low ? Interval{low, high} : Interval{low - 0.5, high + 0.5};
}

Interval values_of(const TimePlot& plot) {
    Interval out{0, 0};
    bool any = false;
    for (const auto& c : plot.curves)
        for (const auto& b : c.bins())
            if (std::isfinite(b.low) && std::isfinite(b.high)) {
                out = any ? Interval{std::min(out.low, b.low), std::max(out.high, b.high)}
                          : Interval{b.low, b.high};
                any = true;
            }
    // The axis includes zero unless the values are far from it.
    if (out.low > 0 && out.low < 0.6 * out.high) out.low = 0;
    if (out.high < 0 && out.high > 0.6 * out.low) out.high = 0;
    if (out.size() <= 1e-12 * std::max(std::abs(out.low), std::abs(out.high)))
        return {out.low - 0.5, out.high + 0.5};
    const double margin = 0.05 * out.size();
    return {out.low == 0 ? 0 : out.low - margin, out.high == 0 ? 0 : out.high + margin};
}

/// Draws the axes, with the seconds of each tick above its cycle.
void draw_time_axes(Canvas& canvas, const Axes& axes, const TimePlot& plot, const AxisStyle& y) {
    const double s = plot.seconds_per_cycle;
    if (!(s > 0)) return draw_axes(canvas, axes, {"cycle", true}, y);
    const Ticks seconds({axes.x.low * s, axes.x.high * s}, static_cast<int>(axes.box.width / 80) + 1);
    AxisStyle x;
    for (const double v : seconds.at()) {
        x.ticks.emplace_back(v / s, seconds.name(v) + " s");
        canvas.text(axes.px(v / s), axes.box.bottom() + 33, fmt::format("{:.0f}", v / s), 11, 0.5, grey);
    }
    draw_axes(canvas, axes, x, y);
    canvas.text(axes.box.x + axes.box.width / 2, axes.box.bottom() + 51, "time, cycle", 13, 0.5);
}

void draw_marks(Canvas& canvas, const TimePlot& plot, const Axes& axes, const Colour& colour) {
    canvas.dashes(2, 3);
    for (const double m : plot.marks)
        if (m >= axes.x.low && m <= axes.x.high)
            canvas.line(axes.px(m), axes.box.y, axes.px(m), axes.box.bottom(), colour);
    canvas.dashes(0, 0);
}

void draw_curve(Canvas& canvas, const Axes& axes, const Curve& curve, const Colour& colour) {
    cairo_t* c = canvas.cairo();
    cairo_set_line_join(c, CAIRO_LINE_JOIN_BEVEL);  // round ones differ from one version of cairo to the next
    bool pen_down = false;
    const auto to = [&](double x, double y) {
        pen_down ? cairo_line_to(c, axes.px(x), axes.py(y)) : cairo_move_to(c, axes.px(x), axes.py(y));
        pen_down = true;
    };
    for (const auto& b : curve.bins()) {
        if (!std::isfinite(b.low) || !std::isfinite(b.high)) {
            pen_down = false;
            continue;
        }
        to(b.first, b.begin);
        if (b.count == 1) continue;
        if (const double middle = (b.first + b.last) / 2;
            b.high > std::max(b.begin, b.end) || b.low < std::min(b.begin, b.end))
            to(middle, b.low), to(middle, b.high);
        to(b.last, b.end);
    }
    canvas.stroke(colour, 1.6);
    if (curve.bins().size() > 1) return;
    for (const auto& b : curve.bins())
        canvas.circle(axes.px(b.first), axes.py(b.low), 3), canvas.fill(colour);
}

Picture lines(const TimePlot& plot) {
    Measure measure;
    double names = 0;
    for (const auto& c : plot.curves) names = std::max(names, measure.canvas().width_of(c.name(), 12));
    const bool legend = plot.curves.size() > 1;
    if (legend) names = std::max(names, measure.canvas().width_of(plot.cells, 12) - 27);
    const bool marked = !plot.marks.empty() && !plot.mark_name.empty();
    if (marked) names = std::max(names, measure.canvas().width_of(plot.mark_name, 12));
    const double right = legend || marked ? 52 + names : 24;
    const Axes axes{{time_left, time_top, time_width, 320}, cycles_of(plot), values_of(plot)};
    const std::vector<Curve> curves(plot.curves.begin(), plot.curves.end());
    return {time_left + time_width + right, time_top + 320 + time_bottom, [=](Canvas& canvas) {
                draw_titles(canvas, plot.title, plot.subtitle);
                if (axes.y.low < 0 && axes.y.high > 0)
                    canvas.line(axes.box.x, axes.py(0), axes.box.right(), axes.py(0), pale);
                draw_marks(canvas, plot, axes, {0.6, 0.6, 0.6});
                cairo_save(canvas.cairo());
                clip(canvas, axes.box);
                for (std::size_t i = 0; i < curves.size(); ++i)
                    draw_curve(canvas, axes, curves[i], category(i));
                cairo_restore(canvas.cairo());
                draw_time_axes(canvas, axes, plot, {plot.quantity});
                double y = time_top + 10;
                const double x = axes.box.right() + 14;
                if (legend) canvas.text(x, y + 4, plot.cells, 12, 0, grey), y += 20;
                for (std::size_t i = 0; legend && i < curves.size(); ++i, y += 20) {
                    canvas.line(x, y, x + 20, y, category(i), 2.5);
                    canvas.text(x + 27, y + 4, curves[i].name(), 12);
                }
                if (!marked) return;
                canvas.dashes(2, 3);
                canvas.line(x + 10, y - 7, x + 10, y + 7, {0.6, 0.6, 0.6});
                canvas.dashes(0, 0);
                canvas.text(x + 27, y + 4, plot.mark_name, 12);
            }};
}

/// The value of each pixel of a row: the one farthest from zero in the bins of that pixel.
std::vector<double> row_values(const Curve& curve, const Interval& cycles) {
    std::vector<double> out;
    const auto& bins = curve.bins();
    for (int column = 0; column < static_cast<int>(time_width) && !bins.empty(); ++column) {
        const double from = cycles.low + cycles.size() * column / time_width,
                     to = cycles.low + cycles.size() * (column + 1) / time_width;
        auto at =
            std::partition_point(bins.begin(), bins.end(), [&](const auto& b) { return b.last < from; });
        if (at == bins.end()) --at;
        if (at != bins.begin() && at->first > to) --at;  // between two samples, the earlier one is used
        double value = std::abs(at->high) >= std::abs(at->low) ? at->high : at->low;
        for (++at; at != bins.end() && at->first < to; ++at)
            for (const double v : {at->low, at->high})
                if (std::abs(v) > std::abs(value)) value = v;
        out.push_back(value);
    }
    return out;
}

Picture rows(const TimePlot& plot) {
    const auto count = static_cast<int>(plot.curves.size());
    const int row = std::clamp(400 / count, 1, 16);
    const double tall = row * count;
    ColourScale scale;
    for (const auto& c : plot.curves)
        for (const auto& b : c.bins()) scale.include(b.high), scale.include(b.low);
    const Interval cells{
        plot.first_cell - 0.5,
        plot.first_cell - 0.5 + static_cast<double>(plot.curves.size() * plot.cells_per_row)};
    Measure measure;
    double names = name_room;
    for (const auto& [at, name] : plot.cell_ticks)
        names = std::max(names, measure.canvas().width_of(name, 12));
    const double left = time_left + names - name_room;
    const Axes axes{{left, time_top, time_width, tall}, cycles_of(plot), cells, true};
    const double bar = std::max(tall, 90.0);
    std::vector<std::vector<double>> values;
    for (const auto& c : plot.curves) values.push_back(row_values(c, axes.x));
    TimePlot shown = plot;
    shown.curves = {};
    if (plot.cells_per_row > 1)
        shown.cells +=
            fmt::format("; a row shows the value furthest from zero of {} cells", plot.cells_per_row);
    return {left + time_width + 22 + 16 + colour_bar_labels, time_top + bar + time_bottom,
            [=](Canvas& canvas) {
                draw_titles(canvas, shown.title, shown.subtitle);
                draw_cells(canvas, axes.box, static_cast<int>(time_width), count, [&](int column, int r) {
                    const auto& row_of = values[static_cast<std::size_t>(r)];
                    return row_of.empty() ? grey : scale(row_of[static_cast<std::size_t>(column)]);
                });
                draw_marks(canvas, shown, axes, scale.interval().low < 0 ? grey : white);
                draw_time_axes(canvas, axes, shown, {shown.cells, true, true, shown.cell_ticks});
                draw_colour_bar(canvas, scale, {axes.box.right() + 22, time_top, 16, bar}, shown.quantity);
            }};
}

}  // namespace

void Curve::add(double cycle, double value) {
    const auto join = [](Bin& a, const Bin& b) {
        a.last = b.last, a.end = b.end, a.low = std::min(a.low, b.low), a.high = std::max(a.high, b.high);
        a.count += b.count;
    };
    const Bin point{cycle, cycle, value, value, value, value, 1};
    if (!bins_.empty() && bins_.back().count < per_bin_)
        join(bins_.back(), point);
    else
        bins_.push_back(point);
    if (bins_.size() <= max_bins_) return;
    for (std::size_t i = 0; 2 * i + 1 < bins_.size(); ++i) {
        bins_[i] = bins_[2 * i];
        join(bins_[i], bins_[2 * i + 1]);
    }
    const bool odd = bins_.size() % 2 == 1;
    if (odd) bins_[bins_.size() / 2] = bins_.back();
    bins_.resize((bins_.size() + 1) / 2);
    per_bin_ *= 2;
}

Picture time_plot(const TimePlot& plot) { return plot.curves.size() <= max_lines ? lines(plot) : rows(plot); }

}  // namespace forage::plot
