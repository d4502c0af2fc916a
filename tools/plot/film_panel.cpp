#include "tools/plot/film_panel.h"

#include <algorithm>
#include <string>

#include <cairo.h>
#include <fmt/format.h>

#include "tools/plot/axes.h"
#include "tools/plot/cairo_handle.h"
#include "tools/plot/world_map.h"

namespace forage::plot {
namespace {

constexpr double clock_height = 30, name_height = 14, picture_aspect = 28.0 / 32;
constexpr std::size_t max_with_rays = 4, rows_of_rays = 3;

/// The layout of a ray sensor's bars; their height shows the activity of the cells.
struct Bars {
    double name, height, gap;  ///< pixels
    double total() const { return name + height + gap; }
};
constexpr Bars large_bars{16, 36, 6}, small_bars{11, 16, 3};

/// Draws the cells of a ray sensor, ordered from the left to the right of the robot.
void draw_bars(Canvas& canvas, const std::vector<double>& cells, const Colour& colour, const Box& box) {
    canvas.fill(box.x, box.y, box.width, box.height, pale);
    const double wide = box.width / static_cast<double>(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k)
        canvas.fill(box.x + static_cast<double>(k) * wide, box.y + box.height * (1 - cells[k]), wide * 0.9,
                    box.height * cells[k], colour);
}

}  // namespace

double FilmPanel::part_height() const {
    const double rays = world_.bugs() > max_with_rays ? 0.0
                                                      : static_cast<double>(rows_of_rays) *
                                                            (single() ? large_bars : small_bars).total();
    return name_height + part_width() * picture_aspect + rays + 8;
}

double FilmPanel::height() const {
    const double rows = single() ? 1.0 : static_cast<double>((robots_shown() + 1) / 2);
    return clock_height + rows * part_height();
}

template <class Draw>
void FilmPanel::for_each_robot(double x, double y, Draw draw) {
    for (std::size_t i = 0; i < robots_shown(); ++i)
        draw(i, x + (i % 2 ? part_width() + 10 : 0),
             y + clock_height + static_cast<double>(i / 2) * part_height());
}

template <class Draw>
void FilmPanel::for_each_ray_sensor(std::size_t robot, double y, Draw draw) {
    if (world_.bugs() > max_with_rays) return;
    const auto& sensors = world_.robot(robot).sensors;
    const auto& seen = sensors.snapshot();
    const Bars size = single() ? large_bars : small_bars;
    y += name_height + part_width() * picture_aspect + size.name;
    const auto add = [&](const char* name, const std::vector<double>& cells, const Colour& colour) {
        if (cells.empty()) return;
        draw(name, cells, colour, y);
        y += size.total();
    };
    add(single() ? "light, from the left to the right" : "light, left to right", seen.target, light_ray);
    add("proximity", seen.proximity, near_ray);
    if (sensors.gripper_scan_requested()) add("between the fingers", seen.gripper, {0.4, 0.4, 0.8});
}

void FilmPanel::draw_names(Canvas& canvas, double x, double y) {
    for_each_robot(x, y, [&](std::size_t i, double left, double top) {
        const std::string name = world_.robot_names()[i];
        canvas.text(left, top + 10,
                    canvas.fitted(single() ? "camera of " + name : fmt::format("{} {}", i + 1, name), 11,
                                  part_width()),
                    11);
        for_each_ray_sensor(i, top, [&](const char* sensor, const auto&, const Colour&, double bars_top) {
            canvas.text(left, bars_top - 3, sensor, single() ? 11 : 9);
        });
    });
}

void FilmPanel::draw(Canvas& canvas, double x, double y) {
    draw_clock(canvas, x, y);
    for_each_robot(x, y, [&](std::size_t i, double left, double top) {
        draw_picture(canvas, i, left, top + name_height);
        for_each_ray_sensor(
            i, top, [&](const char*, const auto& cells, const Colour& colour, double bars_top) {
                draw_bars(canvas, cells, colour,
                          {left, bars_top, part_width(), (single() ? large_bars : small_bars).height});
            });
    });
}

void FilmPanel::draw_clock(Canvas& canvas, double x, double y) {
    canvas.text(x, y + 14, fmt::format("{:.1f} s", world_.time()), 15, 0, black, true);
    const bug::Game& game = world_.game();
    if (game.empty()) return;
    canvas.text(x + 90, y + 14, fmt::format("A {} : {} B", game.points(0), game.points(1)), 15, 0, black,
                true);
    if (game.timed()) canvas.text(x + panel_width, y + 14, fmt::format("{:.0f} s left", game.left()), 12, 1);
}

void FilmPanel::draw_picture(Canvas& canvas, std::size_t robot, double x, double y) {
    const auto picture = world_.image(robot);
    const bug::BugSnapshot& seen = world_.robot(robot).sensors.snapshot();
    const int columns = seen.image_width, rows = seen.image_height;
    const double wide = part_width(), tall = wide * picture_aspect;
    if (picture.empty() || columns == 0) {
        canvas.fill(x, y, wide, tall, pale);
        canvas.text(x + wide / 2, y + tall / 2, "no camera", 11, 0.5, grey);
        return;
    }
    const CairoSurface image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows));
    auto* data = cairo_image_surface_get_data(image.get());
    const int stride = cairo_image_surface_get_stride(image.get());
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto* p = &picture[3 * static_cast<std::size_t>(row * columns + column)];
            reinterpret_cast<std::uint32_t*>(data + row * stride)[column] =
                std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
        }
    cairo_surface_mark_dirty(image.get());
    const double scale = std::min(wide / columns, tall / rows);
    cairo_t* c = canvas.cairo();
    cairo_save(c);
    cairo_translate(c, x, y);
    cairo_scale(c, scale, scale);
    cairo_set_source_surface(c, image.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_NEAREST);
    cairo_paint(c);
    cairo_restore(c);
}

}  // namespace forage::plot
