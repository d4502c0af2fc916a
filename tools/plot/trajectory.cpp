#include "tools/plot/trajectory.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo.h>
#include <fmt/format.h>

#include "tools/plot/axes.h"
#include "tools/plot/world_map.h"

namespace forage::plot {
namespace {

enum class End { reached, missed, unfinished };

End end_of(const Path& p) { return p.reached ? End::reached : p.finished ? End::missed : End::unfinished; }

/// The colour of a path: blue, orange or white by the outcome of the trial, from dark to light by the number
/// of the trial relative to all trials, 0..1.
Colour path_colour(End end, double fraction) {
    const Colour c = end == End::reached  ? Colour{0.40, 0.80, 1}
                     : end == End::missed ? Colour{1, 0.60, 0.15}
                                          : white;
    const double light = 0.6 + 0.4 * std::clamp(fraction, 0.0, 1.0);
    return {c.r * light, c.g * light, c.b * light};
}

class Drawing {
  public:
    Drawing(const bug::World& world, const std::vector<Path>& paths)
        : world_(world), paths_(paths), map_(world, points_of(paths), 760, left, top) {}

    double width() const { return left + std::floor(map_.width()) + right; }
    double height() const { return top + std::floor(map_.height()) + bottom; }

    void draw(Canvas& canvas, const std::string& title) {
        canvas_ = &canvas;
        cairo_save(c());
        clip(canvas, map_.axes().box);
        map_.draw_ground(canvas);
        map_.draw_movable_objects(canvas);
        map_.draw_marks(canvas);
        for (const bool reached : {true, false})  // missed trials are drawn on top, because they are fewer
            for (std::size_t i = 0; i < paths_.size(); ++i)
                if (paths_[i].reached == reached) draw_path(i);
        map_.draw_targets(canvas);
        cairo_restore(c());
        draw_axes(canvas, map_.axes(), {"x (m)"}, {"y (m)"});
        draw_legend();
        canvas.text(12, 22, title, 15, 0, black, true);
    }

  private:
    static constexpr int left = 62, right = 150, top = 34, bottom = 52;  // pixels

    cairo_t* c() const { return canvas_->cairo(); }
    double px(double x) const { return map_.px(x); }
    double py(double y) const { return map_.py(y); }
    static Eigen::AlignedBox2d points_of(const std::vector<Path>& paths) {
        Eigen::AlignedBox2d box;
        for (const auto& p : paths)
            for (const auto& point : p.points) box.extend(point);
        return box;
    }

    void draw_path(std::size_t i) {
        const auto& points = paths_[i].points;
        if (points.empty()) return;
        const Colour colour = path_colour(
            end_of(paths_[i]),
            paths_.size() > 1 ? static_cast<double>(i) / static_cast<double>(paths_.size() - 1) : 1);
        const double width = paths_.size() > 60 ? 1 : 1.6;
        for (const bool halo : {true, false}) {  // a dark outline keeps paths visible on bright patches
            cairo_move_to(c(), px(points[0].x()), py(points[0].y()));
            for (const auto& p : points) cairo_line_to(c(), px(p.x()), py(p.y()));
            canvas_->stroke(halo ? black : colour, halo ? width + 1.4 : width);
        }
        draw_end(px(points.back().x()), py(points.back().y()), end_of(paths_[i]), colour);
    }

    void draw_end(double x, double y, End end, const Colour& colour) {
        for (const bool halo : {true, false}) {
            const Colour& shown = halo ? black : colour;
            if (end == End::reached) {
                canvas_->circle(x, y, halo ? 5 : 3.8);
                canvas_->fill(shown);
                continue;
            }
            if (end == End::unfinished)
                cairo_rectangle(c(), x - 4, y - 4, 8, 8);
            else
                canvas_->segment(x - 5, y - 5, x + 5, y + 5), canvas_->segment(x - 5, y + 5, x + 5, y - 5);
            canvas_->stroke(shown, halo ? 4.5 : 2.2);
        }
    }

    void draw_legend() {
        const double x = px(map_.view().max().x()) + 16;
        double y = top + 14;
        const auto entry = [&](const std::string& what, auto draw) {
            draw();
            canvas_->text(x + 20, y + 4, what, 12);
            y += 24;
        };
        const auto count = [&](End end) {
            return std::ranges::count_if(paths_, [&](const Path& p) { return end_of(p) == end; });
        };
        for (const auto& [end, name] : {std::pair{End::reached, "at the target"},
                                        {End::missed, "missed"},
                                        {End::unfinished, "unfinished"}})
            if (const auto n = count(end))
                entry(world_.start_poses().empty() ? "end of the path" : fmt::format("{} {}", n, name),
                      [&, e = end] { draw_end(x + 7, y, e, path_colour(e, 1)); });
        if (paths_.size() > 1) {
            for (const End end : {End::reached, End::missed})
                for (int i = 0; i < 60; ++i)
                    canvas_->fill(x + 2 * i, y - (end == End::reached ? 8 : 0), 2.5, 8,
                                  path_colour(end, i / 59.0));
            canvas_->text(x, y + 24, fmt::format("trial {}", paths_.front().trial), 12);
            canvas_->text(x + 120, y + 24, fmt::format("{}", paths_.back().trial), 12, 1);
            y += 54;
        }
        const auto outline = [&](double dash, auto shape) {
            canvas_->dashes(dash, dash);
            shape();
            canvas_->stroke({0.3, 0.3, 0.3}, 1.2);
            canvas_->dashes(0, 0);
        };
        if (!world_.targets().empty())
            entry("target", [&] { outline(2, [&] { canvas_->circle(x + 7, y, 6); }); });
        if (world_.reset_plan())
            entry("bounds", [&] { outline(3, [&] { cairo_rectangle(c(), x + 1, y - 6, 12, 12); }); });
    }

    const bug::World& world_;
    const std::vector<Path>& paths_;
    WorldMap map_;
    Canvas* canvas_ = nullptr;  ///< null except while drawing
};

}  // namespace

std::vector<Path> wanted_paths(std::vector<Path> paths, const PlotSpec& spec) {
    std::erase_if(paths, [&](const Path& p) { return !spec.wants(p.trial); });
    return paths;
}

std::string count_of_trials(std::size_t paths) {
    return fmt::format("the run had {} trial{}", paths, paths == 1 ? "" : "s");
}

Picture trajectory_plot(const bug::World& world, std::vector<Path> paths, const std::string& title,
                        std::size_t robot) {
    const auto names = world.robot_names();
    const std::string headline = names.size() > 1 ? names[robot] + ": " + title : title;
    const auto kept = std::make_shared<const std::vector<Path>>(std::move(paths));
    const auto drawing = std::make_shared<Drawing>(world, *kept);
    return {drawing->width(), drawing->height(),
            [kept, drawing, headline](Canvas& canvas) { drawing->draw(canvas, headline); }};
}

}  // namespace forage::plot
