#include "tools/plot/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <cairo.h>
#include <fmt/format.h>

#include "bug_interface/world/png.h"

namespace forage::plot {
namespace {

using Box = Eigen::AlignedBox2d;

struct Free {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
    void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;

/// Dark to light, perceptually even (samples of matplotlib's plasma, from where it shows on black).
constexpr std::array<std::array<double, 3>, 6> path_colours = {{{0.55, 0.20, 0.75},
                                                                {0.78, 0.25, 0.63},
                                                                {0.92, 0.40, 0.46},
                                                                {0.98, 0.57, 0.28},
                                                                {0.99, 0.76, 0.19},
                                                                {0.94, 0.97, 0.30}}};

std::array<double, 3> path_colour(double part) {
    const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(path_colours.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(place), path_colours.size() - 2);
    const double f = place - static_cast<double>(low);
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = (1 - f) * path_colours[low][i] + f * path_colours[low + 1][i];
    return out;
}

/// A round step that gives about `count` ticks over `extent`.
double tick_step(double extent, int count) {
    const double raw = extent / count, power = std::pow(10, std::floor(std::log10(raw)));
    for (const double f : {1.0, 2.0, 5.0})
        if (raw <= f * power) return f * power;
    return 10 * power;
}

class Drawing {
  public:
    Drawing(const bug::World& world, const std::vector<Path>& paths)
        : world_(world), paths_(paths), view_(view()) {
        scale_ = 760 / std::max(view_.sizes().x(), view_.sizes().y());
        width_ = left + static_cast<int>(view_.sizes().x() * scale_) + right;
        height_ = top + static_cast<int>(view_.sizes().y() * scale_) + bottom;
        surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_));
        c_.reset(cairo_create(surface_.get()));
        cairo_select_font_face(c(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    }

    void draw(const std::string& title) {
        cairo_set_source_rgb(c(), 1, 1, 1);
        cairo_paint(c());
        cairo_save(c());
        cairo_rectangle(c(), left, top, view_.sizes().x() * scale_, view_.sizes().y() * scale_);
        cairo_clip(c());
        cairo_set_source_rgb(c(), 0.5, 0.5, 0.5);
        cairo_paint(c());
        for (const auto& floor : world_.floors()) draw_floor(floor);
        for (const auto& d : world_.drawing()) draw_solid(d);
        draw_bounds();
        draw_starts();
        for (const bool reached : {true, false})  // the missed ones on top: they are fewer
            for (std::size_t i = 0; i < paths_.size(); ++i)
                if (paths_[i].reached == reached) draw_path(i);
        draw_targets();
        cairo_restore(c());
        draw_axes();
        draw_legend();
        text(left, 22, title, 15, 0);
    }

    void write(const std::string& path) {
        if (cairo_surface_write_to_png(surface_.get(), path.c_str()) != CAIRO_STATUS_SUCCESS)
            throw std::runtime_error(fmt::format("cannot write '{}'", path));
    }

  private:
    static constexpr int left = 62, right = 150, top = 34, bottom = 52;  // pixels

    cairo_t* c() const { return c_.get(); }
    double px(double x) const { return left + (x - view_.min().x()) * scale_; }
    double py(double y) const { return top + (view_.max().y() - y) * scale_; }

    /// What is shown: the bounds, the walls, the targets and the paths, and a little more.
    Box view() const {
        Box box;
        if (const auto plan = world_.reset_plan()) {
            box.extend(plan->bounds);
            for (const auto& s : plan->starts) box.extend(Eigen::Vector2d(s.x, s.y));
        } else {
            for (const auto& d : world_.drawing()) {
                const Eigen::Vector2d at = d.solid.pose.translation().head<2>();
                const Eigen::Vector2d half = (d.solid.pose.linear().cwiseAbs() * d.solid.size / 2).head<2>();
                box.extend(Eigen::Vector2d(at - half)).extend(Eigen::Vector2d(at + half));
            }
        }
        for (const auto& t : world_.targets()) box.extend(t);
        for (const auto& p : paths_)
            for (const auto& point : p.points) box.extend(point);
        if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
        const double margin = std::max(0.04 * box.sizes().maxCoeff(), 0.5);
        return {box.min().array() - margin, box.max().array() + margin};
    }

    void draw_floor(const bug::Floor& floor) {
        bug::Image image;
        try {
            image = bug::read_png(floor.texture);
        } catch (const std::exception&) {
            return;  // the picture shows paths all the same; the camera reports a floor that cannot be read
        }
        Surface texture(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
        auto* data = cairo_image_surface_get_data(texture.get());
        const int stride = cairo_image_surface_get_stride(texture.get());
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const auto* p = image.pixel(x, y);
                reinterpret_cast<std::uint32_t*>(data + y * stride)[x] =
                    std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
            }
        cairo_surface_mark_dirty(texture.get());
        cairo_save(c());
        cairo_translate(c(), px(floor.x - floor.size_x / 2), py(floor.y + floor.size_y / 2));
        cairo_scale(c(), floor.size_x * scale_ / image.width, floor.size_y * scale_ / image.height);
        cairo_set_source_surface(c(), texture.get(), 0, 0);
        cairo_pattern_set_filter(cairo_get_source(c()), CAIRO_FILTER_GOOD);
        cairo_paint(c());
        cairo_restore(c());
    }

    void draw_solid(const bug::DrawnSolid& d) {
        const Eigen::Vector3d at = d.solid.pose.translation();
        cairo_save(c());
        cairo_translate(c(), px(at.x()), py(at.y()));
        cairo_rotate(c(), -bug::yaw_of(d.solid.pose));
        const double w = d.solid.size.x() * scale_, h = d.solid.size.y() * scale_;
        if (d.solid.kind == bug::ShapeKind::box)
            cairo_rectangle(c(), -w / 2, -h / 2, w, h);
        else
            cairo_arc(c(), 0, 0, w / 2, 0, 2 * M_PI);
        cairo_set_source_rgb(c(), d.colour[0], d.colour[1], d.colour[2]);
        cairo_fill(c());
        cairo_restore(c());
    }

    void draw_bounds() {
        const auto plan = world_.reset_plan();
        if (!plan) return;
        const double dash[] = {6, 5};
        cairo_set_dash(c(), dash, 2, 0);
        cairo_set_line_width(c(), 1);
        cairo_set_source_rgb(c(), 0.65, 0.65, 0.65);
        cairo_rectangle(c(), px(plan->bounds.min().x()), py(plan->bounds.max().y()),
                        plan->bounds.sizes().x() * scale_, plan->bounds.sizes().y() * scale_);
        cairo_stroke(c());
        cairo_set_dash(c(), nullptr, 0, 0);
    }

    void draw_starts() {
        const auto plan = world_.reset_plan();
        if (!plan) return;
        for (const auto& s : plan->starts) {  // an arrow in the robot's direction
            cairo_set_source_rgb(c(), 0.1, 0.1, 0.1);
            cairo_set_line_width(c(), 2);
            const double x = px(s.x), y = py(s.y), l = 0.17 * scale_;
            cairo_move_to(c(), x - l * std::cos(s.yaw), y + l * std::sin(s.yaw));
            cairo_line_to(c(), x + l * std::cos(s.yaw), y - l * std::sin(s.yaw));
            for (const double turn : {2.5, -2.5}) {
                cairo_move_to(c(), x + l * std::cos(s.yaw), y - l * std::sin(s.yaw));
                cairo_rel_line_to(c(), 0.7 * l * std::cos(s.yaw + turn), -0.7 * l * std::sin(s.yaw + turn));
            }
            cairo_stroke(c());
        }
    }

    void draw_targets() {
        for (const auto& t : world_.targets()) {  // the ring that counts as reached
            cairo_set_source_rgb(c(), 1, 1, 1);
            cairo_set_line_width(c(), 1.5);
            const double dash[] = {3, 3};
            cairo_set_dash(c(), dash, 2, 0);
            cairo_arc(c(), px(t.x()), py(t.y()), bug::Trial::reach * scale_, 0, 2 * M_PI);
            cairo_stroke(c());
            cairo_set_dash(c(), nullptr, 0, 0);
        }
    }

    void draw_path(std::size_t i) {
        const auto& points = paths_[i].points;
        if (points.empty()) return;
        const auto colour = path_colour(
            paths_.size() > 1 ? static_cast<double>(i) / static_cast<double>(paths_.size() - 1) : 1);
        const double width = paths_.size() > 60 ? 1 : 1.6;
        for (const bool halo : {true, false}) {  // a dark rim keeps a path visible on bright patches
            cairo_set_source_rgb(c(), halo ? 0 : colour[0], halo ? 0 : colour[1], halo ? 0 : colour[2]);
            cairo_set_line_width(c(), halo ? width + 1.4 : width);
            cairo_move_to(c(), px(points[0].x()), py(points[0].y()));
            for (const auto& p : points) cairo_line_to(c(), px(p.x()), py(p.y()));
            cairo_stroke(c());
        }
        draw_end(px(points.back().x()), py(points.back().y()), end_of(paths_[i]), colour);
    }

    enum class End { reached, missed, unfinished };
    static End end_of(const Path& p) {
        return p.reached ? End::reached : p.finished ? End::missed : End::unfinished;
    }

    void draw_end(double x, double y, End end, const std::array<double, 3>& colour) {
        for (const bool halo : {true, false}) {
            cairo_set_source_rgb(c(), halo ? 0 : colour[0], halo ? 0 : colour[1], halo ? 0 : colour[2]);
            if (end == End::reached) {
                cairo_arc(c(), x, y, halo ? 5 : 3.8, 0, 2 * M_PI);
                cairo_fill(c());
            } else if (end == End::unfinished) {
                cairo_set_line_width(c(), halo ? 4.5 : 2.2);
                cairo_rectangle(c(), x - 4, y - 4, 8, 8);
                cairo_stroke(c());
            } else {
                cairo_set_line_width(c(), halo ? 4.5 : 2.2);
                cairo_move_to(c(), x - 5, y - 5), cairo_line_to(c(), x + 5, y + 5);
                cairo_move_to(c(), x - 5, y + 5), cairo_line_to(c(), x + 5, y - 5);
                cairo_stroke(c());
            }
        }
    }

    /// `anchor` 0: starts at x; 0.5: centred; 1: ends at x.
    void text(double x, double y, const std::string& what, double size, double anchor) {
        cairo_set_font_size(c(), size);
        cairo_text_extents_t extents;
        cairo_text_extents(c(), what.c_str(), &extents);
        cairo_set_source_rgb(c(), 0, 0, 0);
        cairo_move_to(c(), x - anchor * extents.width, y);
        cairo_show_text(c(), what.c_str());
        cairo_new_path(c());  // showing text leaves a current point, from which an arc would draw a line
    }

    void draw_axes() {
        cairo_set_line_width(c(), 1);
        cairo_set_source_rgb(c(), 0, 0, 0);
        const double x0 = left, x1 = px(view_.max().x()), y0 = py(view_.min().y()), y1 = top;
        cairo_rectangle(c(), x0, y1, x1 - x0, y0 - y1);
        cairo_stroke(c());
        const double step = tick_step(view_.sizes().maxCoeff(), 7);
        for (double v = std::ceil(view_.min().x() / step) * step; v <= view_.max().x(); v += step) {
            cairo_move_to(c(), px(v), y0), cairo_rel_line_to(c(), 0, 5), cairo_stroke(c());
            text(px(v), y0 + 19, fmt::format("{:g}", std::round(v / step) * step + 0.0), 12, 0.5);
        }
        for (double v = std::ceil(view_.min().y() / step) * step; v <= view_.max().y(); v += step) {
            cairo_move_to(c(), x0, py(v)), cairo_rel_line_to(c(), -5, 0), cairo_stroke(c());
            text(x0 - 9, py(v) + 4, fmt::format("{:g}", std::round(v / step) * step + 0.0), 12, 1);
        }
        text((x0 + x1) / 2, y0 + 40, "x (m)", 13, 0.5);
        cairo_save(c());
        cairo_translate(c(), 18, (y0 + y1) / 2);
        cairo_rotate(c(), -M_PI / 2);
        text(0, 0, "y (m)", 13, 0.5);
        cairo_restore(c());
    }

    void draw_legend() {
        const double x = px(view_.max().x()) + 16;
        double y = top + 14;
        if (paths_.size() > 1) {
            text(x, y, "trial", 13, 0);
            const double bar = 160;
            for (int i = 0; i < static_cast<int>(bar); ++i) {
                const auto colour = path_colour(i / (bar - 1));
                cairo_set_source_rgb(c(), colour[0], colour[1], colour[2]);
                cairo_rectangle(c(), x, y + 10 + i, 14, 1.5);
                cairo_fill(c());
            }
            text(x + 20, y + 19, "1", 12, 0);
            text(x + 20, y + 10 + bar, fmt::format("{}", paths_.size()), 12, 0);
            y += bar + 40;
        }
        const auto entry = [&](const std::string& what, auto draw) {
            draw();
            text(x + 20, y + 4, what, 12, 0);
            y += 24;
        };
        const auto count = [&](End end) {
            return std::count_if(paths_.begin(), paths_.end(),
                                 [&](const Path& p) { return end_of(p) == end; });
        };
        for (const auto& [end, name] : {std::pair{End::reached, "at the target"},
                                        {End::missed, "missed"},
                                        {End::unfinished, "unfinished"}})
            if (const auto n = count(end))
                entry(fmt::format("{} {}", n, name), [&, e = end] { draw_end(x + 7, y, e, path_colour(1)); });
        const auto outline = [&](double dash, auto shape) {
            const double dashes[] = {dash, dash};
            cairo_set_dash(c(), dashes, 2, 0);
            cairo_set_line_width(c(), 1.2);
            cairo_set_source_rgb(c(), 0.3, 0.3, 0.3);
            shape();
            cairo_stroke(c());
            cairo_set_dash(c(), nullptr, 0, 0);
        };
        if (!world_.targets().empty())
            entry("target", [&] { outline(2, [&] { cairo_arc(c(), x + 7, y, 6, 0, 2 * M_PI); }); });
        if (world_.reset_plan())
            entry("bounds", [&] { outline(3, [&] { cairo_rectangle(c(), x + 1, y - 6, 12, 12); }); });
    }

    const bug::World& world_;
    const std::vector<Path>& paths_;
    Box view_;
    double scale_ = 1;  ///< pixels per metre
    int width_ = 0, height_ = 0;
    Surface surface_;
    std::unique_ptr<cairo_t, Free> c_;
};

}  // namespace

void draw_trajectory(const bug::World& world, const std::vector<Path>& paths, const std::string& title,
                     const std::string& png) {
    Drawing drawing(world, paths);
    drawing.draw(title);
    drawing.write(png);
}

}  // namespace forage::plot
