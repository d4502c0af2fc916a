#include "tools/plot/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <cairo.h>
#include <fmt/format.h>

#include "tools/plot/world_map.h"

namespace forage::plot {
namespace {

struct Free {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
    void operator()(cairo_t* c) const { cairo_destroy(c); }
};

constexpr double margin = 10, head = 30, map_size = 600, panel = 270;
constexpr std::size_t most_pictures = 8;

}  // namespace

/// The surface that every frame is drawn on. What stands still is drawn once.
class Film::Screen {
  public:
    Screen(bug::World& world, std::string title)
        : world_(world),
          title_(std::move(title)),
          map_(world, {}, map_size, margin, head),
          width_(static_cast<int>(std::ceil(margin + map_.width() + margin + panel + margin))),
          height_(static_cast<int>(std::ceil(head + std::max(map_.height(), panel + 120) + margin))),
          ground_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_)),
          surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_)),
          context_(cairo_create(surface_.get())),
          canvas_(context_.get()) {
        const std::unique_ptr<cairo_t, Free> context(cairo_create(ground_.get()));
        Canvas canvas(context.get());
        canvas.fill(0, 0, width_, height_, white);
        canvas.text(margin, 20, title_, 14, 0, black, true);
        cairo_rectangle(context.get(), margin, head, map_.width(), map_.height());
        cairo_clip(context.get());
        map_.draw_ground(canvas);
        map_.draw_marks(canvas);
        map_.draw_targets(canvas);
    }

    void draw() {
        cairo_t* c = context_.get();
        cairo_set_source_surface(c, ground_.get(), 0, 0);
        cairo_paint(c);
        cairo_save(c);
        cairo_rectangle(c, margin, head, map_.width(), map_.height());
        cairo_clip(c);
        map_.draw_loose(canvas_);
        for (std::size_t i = 0; i < world_.bugs(); ++i) map_.draw_robot(canvas_, i, true);
        if (world_.bugs() > 1)
            for (std::size_t i = 0; i < world_.bugs(); ++i) draw_number(i);
        cairo_restore(c);
        draw_clock();
        draw_pictures();
    }

    Pixels pixels() const {
        cairo_surface_flush(surface_.get());
        Pixels out{width_, height_, {}};
        const auto* data = cairo_image_surface_get_data(surface_.get());
        const int stride = cairo_image_surface_get_stride(surface_.get());
        for (int y = 0; y < height_; ++y) {
            const auto* row = reinterpret_cast<const std::uint32_t*>(data + y * stride);
            for (int x = 0; x < width_; ++x) out.rgb.push_back(row[x] & 0xffffffu);
        }
        return out;
    }
    void write_png(const std::string& name) const {
        if (cairo_surface_write_to_png(surface_.get(), name.c_str()) != CAIRO_STATUS_SUCCESS)
            throw std::runtime_error(fmt::format("cannot write '{}'", name));
    }

  private:
    double panel_x() const { return margin + map_.width() + margin; }

    void draw_number(std::size_t i) {
        const auto& at = world_.pose(i);
        const double x = map_.px(at.x), y = map_.py(at.y) - world_.robot(i).body.radius * map_.scale() - 4;
        canvas_.fill(x - 6, y - 10, 12, 13, white);
        canvas_.text(x, y, std::to_string(i + 1), 11, 0.5, black, true);
    }

    void draw_clock() {
        double y = head + 14;
        canvas_.text(panel_x(), y, fmt::format("{:.1f} s", world_.time()), 15, 0, black, true);
        const bug::Game& game = world_.game();
        if (!game.empty()) {
            canvas_.text(panel_x() + 90, y, fmt::format("A {} : {} B", game.points(0), game.points(1)), 15, 0,
                         black, true);
            if (game.timed())
                canvas_.text(panel_x() + panel, y, fmt::format("{:.0f} s left", game.left()), 12, 1);
        }
    }

    /// One picture large, more of them smaller, in two columns.
    void draw_pictures() {
        const std::size_t n = std::min(world_.bugs(), most_pictures);
        const double wide = n > 1 ? (panel - 10) / 2 : panel;
        double x = panel_x(), y = head + 30;
        for (std::size_t i = 0; i < n; ++i) {
            const double tall = draw_picture(i, x, y + 14, wide);
            canvas_.text(x, y + 10,
                         canvas_.fitted(n > 1 ? fmt::format("{} {}", i + 1, world_.bug_names()[i])
                                              : fmt::format("camera of {}", world_.bug_names()[i]),
                                        11, wide),
                         11);
            if (n == 1) return draw_senses(0, x, y + 14 + tall + 16);
            if (i % 2) y += tall + 22;
            x = i % 2 ? panel_x() : panel_x() + wide + 10;
        }
    }

    double draw_picture(std::size_t robot, double x, double y, double wide) {
        const auto picture = world_.image(robot);
        const bug::BugSnapshot& seen = world_.robot(robot).snapshot;
        const int columns = seen.image_width, rows = seen.image_height;
        if (picture.empty() || columns == 0) {
            canvas_.fill(x, y, wide, wide * 0.3, pale);
            canvas_.text(x + wide / 2, y + wide * 0.18, "no camera", 11, 0.5, grey);
            return wide * 0.875;
        }
        const std::unique_ptr<cairo_surface_t, Free> image(
            cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows));
        auto* data = cairo_image_surface_get_data(image.get());
        const int stride = cairo_image_surface_get_stride(image.get());
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const auto* p = &picture[3 * static_cast<std::size_t>(row * columns + column)];
                reinterpret_cast<std::uint32_t*>(data + row * stride)[column] =
                    std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
            }
        cairo_surface_mark_dirty(image.get());
        cairo_t* c = context_.get();
        cairo_save(c);
        cairo_translate(c, x, y);
        cairo_scale(c, wide / columns, wide / columns);
        cairo_set_source_surface(c, image.get(), 0, 0);
        cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_NEAREST);
        cairo_paint(c);
        cairo_restore(c);
        return wide * rows / columns;
    }

    /// The cells of the ray sensors, from the left to the right of the robot.
    void draw_senses(std::size_t robot, double x, double y) {
        const auto& seen = world_.robot(robot).snapshot;  // not late, as those of modules may be
        const auto bars = [&](const char* name, const std::vector<double>& cells, const Colour& colour) {
            if (cells.empty()) return;
            canvas_.text(x, y, name, 11);
            canvas_.fill(x, y + 5, panel, 36, pale);
            const double wide = panel / static_cast<double>(cells.size());
            for (std::size_t k = 0; k < cells.size(); ++k)
                canvas_.fill(x + static_cast<double>(k) * wide, y + 5 + 36 * (1 - cells[k]), wide - 1,
                             36 * cells[k], colour);
            y += 58;
        };
        bars("light, from the left to the right", seen.target, {0.95, 0.75, 0.05});
        bars("proximity", seen.proximity, {0.95, 0.25, 0.15});
        if (world_.robot(robot).wants_gripper_scan)
            bars("between the fingers", seen.gripper, {0.4, 0.4, 0.8});
    }

    bug::World& world_;
    std::string title_;
    WorldMap map_;
    int width_, height_;
    std::unique_ptr<cairo_surface_t, Free> ground_, surface_;
    std::unique_ptr<cairo_t, Free> context_;
    Canvas canvas_;
};

Film::Film(bug::World& world, std::string name, double seconds_per_frame, std::string title)
    : name_(std::move(name)), screen_(std::make_unique<Screen>(world, std::move(title))) {
    if (name_.ends_with(".gif")) gif_.emplace(name_, seconds_per_frame);
}

Film::~Film() = default;

bool Film::is_name(const std::string& name) { return name.ends_with(".gif") || name.ends_with(".png"); }

void Film::add() {
    screen_->draw();
    ++frames_;
    if (gif_)
        gif_->add(screen_->pixels());
    else
        screen_->write_png(fmt::format("{}_{:05}.png", name_.substr(0, name_.size() - 4), frames_));
}

std::size_t Film::finish() {
    if (gif_) gif_->finish();
    return frames_;
}

}  // namespace forage::plot
