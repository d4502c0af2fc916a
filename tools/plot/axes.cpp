#include "tools/plot/axes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace forage::plot {
namespace {

/// Calls `f` with the first and the last of neighbours of the same name.
template <class F>
void for_each_run(const std::vector<std::string>& names, F f) {
    for (std::size_t i = 0, end = 0; i < names.size(); i = end) {
        while (end < names.size() && names[end] == names[i]) ++end;
        f(i, end - 1);
    }
}

constexpr double tick_size = 12, title_size = 13;

double round_step(double raw) {
    const double power = std::pow(10, std::floor(std::log10(raw)));
    for (const double f : {1.0, 2.0, 5.0})
        if (raw <= f * power * (1 + 1e-9)) return f * power;
    return 10 * power;
}

std::vector<std::pair<double, std::string>> ticks_of(const AxisStyle& style, Interval interval, int count) {
    if (!style.ticks.empty()) return style.ticks;
    const Ticks ticks(interval, count, style.whole);
    std::vector<std::pair<double, std::string>> out;
    for (const double v : ticks.at()) out.emplace_back(v, ticks.name(v));
    return out;
}

}  // namespace

Ticks::Ticks(Interval interval, int count, bool whole) : step_(1) {
    if (!(interval.size() > 0) || !std::isfinite(interval.size())) return;
    step_ = round_step(interval.size() / std::max(count, 1));
    if (whole) step_ = std::max(1.0, std::round(step_));
    const auto first = std::ceil(interval.low / step_ - 1e-9);
    for (double i = first; i * step_ <= interval.high + 1e-9 * step_ && at_.size() < 100; ++i)
        at_.push_back(i * step_ + 0.0);  // + 0.0 turns -0 into 0
}

std::string Ticks::name(double value) const {
    const double size = std::max(std::abs(value), step_);
    if (size >= 1e6 || step_ < 1e-5) {
        const int digits =
            static_cast<int>(std::floor(std::log10(size) + 1e-9) - std::floor(std::log10(step_) + 1e-9));
        return value == 0 ? "0" : fmt::format("{:.{}e}", value, digits);
    }
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step_) + 1e-9)));
    return fmt::format("{:.{}f}", value, decimals);
}

std::string moment_text(std::uint64_t cycle, double seconds_per_cycle) {
    if (!(seconds_per_cycle > 0)) return fmt::format("cycle {}", cycle);
    const double seconds = std::round(static_cast<double>(cycle) * seconds_per_cycle * 100) / 100;
    return fmt::format("{} s (cycle {})", seconds, cycle);
}

void draw_titles(Canvas& canvas, const std::string& title, const std::string& subtitle) {
    canvas.text(12, 22, title, 15, 0, black, true);
    canvas.text(12, 40, subtitle, 12, 0, grey);
}

double width_of_titles(Canvas& canvas, const std::string& title, const std::string& subtitle) {
    return 24 + std::max(canvas.width_of(title, 15, true), canvas.width_of(subtitle, 12));
}

void clip(Canvas& canvas, const Box& box) {
    cairo_rectangle(canvas.cairo(), box.x, box.y, box.width, box.height);
    cairo_clip(canvas.cairo());
}

void draw_frame(Canvas& canvas, const Box& box, const Colour& colour) {
    cairo_rectangle(canvas.cairo(), box.x - 0.5, box.y - 0.5, box.width + 1, box.height + 1);
    canvas.stroke(colour);
}

std::vector<std::pair<double, std::string>> name_ticks(const std::vector<std::string>& names, double first) {
    std::vector<std::pair<double, std::string>> out;
    for_each_run(names, [&](std::size_t from, std::size_t to) {
        out.emplace_back(first + static_cast<double>(from + to) / 2, names[from]);
    });
    return out;
}

std::vector<std::pair<double, std::string>> numbered_ticks(const std::vector<std::string>& names, int first) {
    auto out = name_ticks(names, first);
    std::size_t i = 0;
    for_each_run(names, [&](std::size_t from, std::size_t to) {
        const auto number = [&](std::size_t k) { return std::to_string(first + static_cast<int>(k)); };
        auto& text = out[i++].second;
        text = number(from) + (to > from ? "-" + number(to) : "") + (text.empty() ? "" : " " + text);
    });
    return out;
}

void draw_axes(Canvas& canvas, const Axes& axes, const AxisStyle& x, const AxisStyle& y) {
    const Box& b = axes.box;
    draw_frame(canvas, b, black);
    double free_from = -1e9;
    for (const auto& [v, name] :
         ticks_of(x, axes.x, static_cast<int>(b.width / (axes.x.size() < 100 ? 40 : 80)) + 1)) {
        canvas.line(axes.px(v), b.bottom() + 0.5, axes.px(v), b.bottom() + 5, black);
        const double half = canvas.width_of(name, tick_size) / 2;
        if (!x.named || axes.px(v) - half < free_from) continue;
        canvas.text(axes.px(v), b.bottom() + 18, name, tick_size, 0.5);
        free_from = axes.px(v) + half + 6;
    }
    double widest = 0, last = -1e9;
    for (const auto& [v, name] : ticks_of(y, axes.y, static_cast<int>(b.height / (y.whole ? 30 : 50)) + 1)) {
        if (!y.ticks.empty() && std::abs(axes.py(v) - last) < 13) continue;
        canvas.line(b.x - 0.5, axes.py(v), b.x - 5, axes.py(v), black);
        if (!y.named || std::abs(axes.py(v) - last) < 13) continue;
        last = axes.py(v);
        canvas.text(b.x - 8, last + 4.3, name, tick_size, 1);
        widest = std::max(widest, canvas.width_of(name, tick_size));
    }
    if (!x.title.empty()) canvas.text(b.x + b.width / 2, b.bottom() + 37, x.title, title_size, 0.5);
    if (!y.title.empty()) canvas.text_upwards(b.x - 17 - widest, b.y + b.height / 2, y.title, title_size);
}

void ColourScale::include(double value) {
    if (!std::isfinite(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
}

Interval ColourScale::interval() const {
    if (low_ < 0) {
        const double reach = std::max(-low_, high_);
        return {-reach, reach};
    }
    return {0, high_ > 0 ? high_ : 1};
}

Colour ColourScale::at(double fraction) const {
    return low_ < 0 ? diverging(2 * fraction - 1) : sequential(fraction);
}

Colour ColourScale::operator()(double value) const {
    if (!std::isfinite(value)) return grey;
    const Interval i = interval();
    return at((value - i.low) / i.size());
}

void draw_colour_bar(Canvas& canvas, const ColourScale& scale, const Box& box, const std::string& title) {
    const int steps = std::max(2, static_cast<int>(box.height));
    draw_cells(canvas, box, 1, steps, [&](int, int row) { return scale.at(1 - row / (steps - 1.0)); });
    draw_frame(canvas, box, black);
    const Axes axes{box, {0, 1}, scale.interval()};
    const Ticks ticks(axes.y, std::max(2, static_cast<int>(box.height / 45)));
    double widest = 0;
    for (const double v : ticks.at()) {
        canvas.line(box.right() + 0.5, axes.py(v), box.right() + 5, axes.py(v), black);
        canvas.text(box.right() + 8, axes.py(v) + 4.3, ticks.name(v), tick_size);
        widest = std::max(widest, canvas.width_of(ticks.name(v), tick_size));
    }
    canvas.text_upwards(box.right() + widest + 25, box.y + box.height / 2,
                        canvas.fitted(title, title_size, std::max(box.height, 80.0)), title_size);
}

CellSize cell_size(int columns, int rows, int room_x, int room_y, int largest, int least) {
    const int square = std::clamp(std::min(room_x / columns, room_y / rows), 1, largest);
    return {std::max(square, std::min(largest, least / columns)),
            std::max(square, std::min(largest, least / rows))};
}

void draw_cells(Canvas& canvas, const Box& box, int columns, int rows,
                const std::function<Colour(int, int)>& colour) {
    // The image has the resolution of the box, so that cells are sharp in viewers that interpolate images.
    const int width = std::max(1, static_cast<int>(std::lround(box.width)));
    const int height = std::max(1, static_cast<int>(std::lround(box.height)));
    cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    unsigned char* data = cairo_image_surface_get_data(image);
    const int stride = cairo_image_surface_get_stride(image);
    std::vector<std::uint32_t> line(static_cast<std::size_t>(columns));
    const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(v * 255)); };
    for (int y = 0, drawn = -1; y < height; ++y) {
        const int row = static_cast<int>(static_cast<long long>(y) * rows / height);
        if (row != drawn)
            for (int column = 0; column < columns; ++column) {
                const Colour c = colour(column, row);
                line[static_cast<std::size_t>(column)] = byte(c.r) << 16 | byte(c.g) << 8 | byte(c.b);
            }
        drawn = row;
        auto* pixels = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
        for (int x = 0; x < width; ++x)
            pixels[x] = line[static_cast<std::size_t>(static_cast<long long>(x) * columns / width)];
    }
    cairo_surface_mark_dirty(image);
    cairo_save(canvas.cairo());
    cairo_translate(canvas.cairo(), box.x, box.y);
    cairo_scale(canvas.cairo(), box.width / width, box.height / height);
    cairo_set_source_surface(canvas.cairo(), image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(canvas.cairo()), CAIRO_FILTER_NEAREST);
    cairo_rectangle(canvas.cairo(), 0, 0, width, height);
    cairo_fill(canvas.cairo());
    cairo_restore(canvas.cairo());
    cairo_surface_destroy(image);
}

}  // namespace forage::plot
