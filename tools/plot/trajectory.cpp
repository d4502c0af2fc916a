#include "tools/plot/trajectory.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo.h>
#include <fmt/format.h>

#include "bug_interface/world/png.h"
#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

using Box = Eigen::AlignedBox2d;

struct Free {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;

enum class End { reached, missed, unfinished };

End end_of(const Path& p) { return p.reached ? End::reached : p.finished ? End::missed : End::unfinished; }

/// Of a trial by its outcome, and by its place among all, 0..1: blue, orange or white, from dark to light.
Colour path_colour(End end, double part) {
    const Colour c = end == End::reached  ? Colour{0.40, 0.80, 1}
                     : end == End::missed ? Colour{1, 0.60, 0.15}
                                          : white;
    const double light = 0.6 + 0.4 * std::clamp(part, 0.0, 1.0);
    return {c.r * light, c.g * light, c.b * light};
}

class Drawing {
  public:
    Drawing(const bug::World& world, const std::vector<Path>& paths)
        : world_(world), paths_(paths), view_(view()) {
        scale_ = 760 / std::max(view_.sizes().x(), view_.sizes().y());
    }

    double width() const { return left + std::floor(view_.sizes().x() * scale_) + right; }
    double height() const { return top + std::floor(view_.sizes().y() * scale_) + bottom; }

    void draw(Canvas& canvas, const std::string& title) {
        canvas_ = &canvas;
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
        canvas.text(12, 22, title, 15, 0, black, true);
    }

  private:
    static constexpr int left = 62, right = 150, top = 34, bottom = 52;  // pixels

    cairo_t* c() const { return canvas_->cairo(); }
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
        const Colour colour = path_colour(
            end_of(paths_[i]),
            paths_.size() > 1 ? static_cast<double>(i) / static_cast<double>(paths_.size() - 1) : 1);
        const double width = paths_.size() > 60 ? 1 : 1.6;
        for (const bool halo : {true, false}) {  // a dark rim keeps a path visible on bright patches
            canvas_->colour(halo ? black : colour);
            cairo_set_line_width(c(), halo ? width + 1.4 : width);
            cairo_move_to(c(), px(points[0].x()), py(points[0].y()));
            for (const auto& p : points) cairo_line_to(c(), px(p.x()), py(p.y()));
            cairo_stroke(c());
        }
        draw_end(px(points.back().x()), py(points.back().y()), end_of(paths_[i]), colour);
    }

    void draw_end(double x, double y, End end, const Colour& colour) {
        for (const bool halo : {true, false}) {
            canvas_->colour(halo ? black : colour);
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

    void draw_axes() {
        const Axes axes{{left, top, view_.sizes().x() * scale_, view_.sizes().y() * scale_},
                        {view_.min().x(), view_.max().x()},
                        {view_.min().y(), view_.max().y()}};
        plot::draw_axes(*canvas_, axes, {"x (m)"}, {"y (m)"});
    }

    void draw_legend() {
        const double x = px(view_.max().x()) + 16;
        double y = top + 14;
        const auto entry = [&](const std::string& what, auto draw) {
            draw();
            canvas_->text(x + 20, y + 4, what, 12);
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
                entry(fmt::format("{} {}", n, name),
                      [&, e = end] { draw_end(x + 7, y, e, path_colour(e, 1)); });
        if (paths_.size() > 1) {
            for (const End end : {End::reached, End::missed})
                for (int i = 0; i < 60; ++i) {
                    canvas_->colour(path_colour(end, i / 59.0));
                    cairo_rectangle(c(), x + 2 * i, y - (end == End::reached ? 8 : 0), 2.5, 8);
                    cairo_fill(c());
                }
            canvas_->text(x, y + 24, "trial 1", 12);
            canvas_->text(x + 120, y + 24, fmt::format("{}", paths_.size()), 12, 1);
            y += 54;
        }
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
    double scale_ = 1;          ///< pixels per metre
    Canvas* canvas_ = nullptr;  ///< while it is drawn on
};

}  // namespace

Picture trajectory_plot(const bug::World& world, std::vector<Path> paths, const std::string& title) {
    const auto kept = std::make_shared<const std::vector<Path>>(std::move(paths));
    const auto drawing = std::make_shared<Drawing>(world, *kept);
    return {drawing->width(), drawing->height(),
            [kept, drawing, title](Canvas& canvas) { drawing->draw(canvas, title); }};
}

}  // namespace forage::plot
