#include "tools/plot/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <cairo.h>
#include <fmt/format.h>

#include "tools/plot/cairo_handle.h"
#include "tools/plot/film_panel.h"
#include "tools/plot/world_labels.h"

namespace forage::plot {
namespace {

constexpr double film_margin = 10, film_head = 30, film_foot = 26;

/// The size of the map. It is larger for large arenas, in which robots would be too small.
WorldMap map_of(const bug::World& world) {
    constexpr double size = 600, largest = 900, pixels_per_metre = 30;
    const WorldMap map(world, {}, size, film_margin, film_head);
    if (map.scale() >= pixels_per_metre) return map;
    return {world, {}, std::min(largest, size * pixels_per_metre / map.scale()), film_margin, film_head};
}

}  // namespace

/// The surface for all frames. The static part of the world is drawn only once.
class Film::Screen {
  public:
    Screen(bug::World& world, const std::string& title, const FilmGroups& groups)
        : world_(world),
          map_(map_of(world)),
          panel_(world),
          groups_(groups),
          width_(static_cast<int>(
              std::ceil(groups_left() + (groups.empty() ? 0 : groups.width() + film_margin)))),
          height_(static_cast<int>(std::ceil(
              film_head + std::max({map_.height(), panel_.height(), groups.height()}) + film_foot))),
          ground_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_)),
          surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_)),
          context_(cairo_create(surface_.get())),
          canvas_(context_.get()) {
        const CairoContext context(cairo_create(ground_.get()));
        Canvas canvas(context.get());
        canvas.fill(0, 0, width_, height_, white);
        canvas.text(film_margin, 20, title, 14, 0, black, true);
        draw_legend(canvas, world, film_margin, width_ - film_margin, height_ - 9);
        panel_.draw_names(canvas, panel_left(), film_head);
        clip(canvas, map_.axes().box);
        map_.draw_ground(canvas);
        map_.draw_marks(canvas);
        map_.draw_targets(canvas);
    }

    void draw() {
        cairo_t* c = context_.get();
        cairo_set_source_surface(c, ground_.get(), 0, 0);
        cairo_paint(c);
        cairo_save(c);
        clip(canvas_, map_.axes().box);
        map_.draw_movable_objects(canvas_);
        for (std::size_t i = 0; i < world_.bugs(); ++i) map_.draw_robot(canvas_, i, true);
        if (world_.bugs() > 1)
            for (std::size_t i = 0; i < world_.bugs(); ++i) draw_number(i);
        cairo_restore(c);
        panel_.draw(canvas_, panel_left(), film_head);
        groups_.draw(canvas_, groups_left(), film_head);
    }

    Pixels pixels() { return pixels_of(surface_.get()); }
    void write_png(const std::string& name) const {
        if (cairo_surface_write_to_png(surface_.get(), name.c_str()) != CAIRO_STATUS_SUCCESS)
            throw std::runtime_error(fmt::format("cannot write '{}'", name));
    }

  private:
    double panel_left() const { return film_margin + map_.width() + film_margin; }
    double groups_left() const { return panel_left() + panel_width + film_margin; }
    void draw_number(std::size_t i) {
        const auto& at = world_.pose(i);
        const double x = map_.px(at.x), y = map_.py(at.y) - world_.robot(i).body.radius * map_.scale() - 4;
        canvas_.fill(x - 6, y - 10, 12, 13, white);
        canvas_.text(x, y, std::to_string(i + 1), 11, 0.5, black, true);
    }

    bug::World& world_;
    WorldMap map_;
    FilmPanel panel_;
    const FilmGroups& groups_;
    int width_, height_;
    CairoSurface ground_, surface_;
    CairoContext context_;
    Canvas canvas_;
};

Film::Film(bug::World& world, std::string name, double seconds_per_frame, std::string title,
           std::vector<observe::Source> groups)
    : world_(world), name_(std::move(name)), title_(std::move(title)), groups_(std::move(groups)) {
    if (name_.ends_with(".gif")) gif_.emplace(name_, seconds_per_frame);
    if (name_.ends_with(".mp4")) mp4_.emplace(name_, seconds_per_frame);
}

Film::~Film() = default;

void Film::check_name(const std::string& name, const std::string& option, Diagnostics& diagnostics) {
    if (!name.ends_with(".gif") && !name.ends_with(".mp4") && !name.ends_with(".png"))
        diagnostics.error({}, fmt::format("{}: '{}' is not the name of a film", option, name),
                          "it ends with .gif, .mp4 or .png");
    else if (name.ends_with(".mp4") && !has_ffmpeg())
        diagnostics.error(
            {}, fmt::format("{}: '{}' needs the program ffmpeg, which is not installed", option, name),
            "Debian and Ubuntu: apt-get install ffmpeg; a film that ends with .gif needs none");
}

std::string Film::frame_name(const std::string& name, std::size_t frame) {
    return fmt::format("{}_{:05}.png", name.substr(0, name.size() - 4), frame);
}

Pixels Film::draw() {
    if (!screen_) screen_ = std::make_unique<Screen>(world_, title_, groups_);
    screen_->draw();
    return screen_->pixels();
}

void Film::add() {
    // The ground is drawn now, because it has the names of the sensors that the first cycle has asked for.
    if (!screen_) screen_ = std::make_unique<Screen>(world_, title_, groups_);
    screen_->draw();
    if (gif_)
        gif_->add(screen_->pixels());
    else if (mp4_)
        mp4_->add(screen_->pixels());
    else
        screen_->write_png(frame_name(name_, frames_ + 1));
    ++frames_;
}

std::size_t Film::finish() {
    if (gif_) gif_->finish();
    if (mp4_) mp4_->finish();
    return frames_;
}

}  // namespace forage::plot
