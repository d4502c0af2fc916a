#include "tools/plot/occupancy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "core/run/trial_recorder.h"
#include "tools/plot/axes.h"
#include "tools/plot/world_map.h"

namespace forage::plot {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr int occupancy_left = 62, occupancy_top = 58, occupancy_bottom = 52;
constexpr double name_text = 12, name_line = 14;
constexpr std::size_t mean_points = 80;  ///< of a mean path

/// Places on a path after equal shares of its length.
Points resampled(const Points& path) {
    std::vector<double> length = {0};
    for (std::size_t i = 1; i < path.size(); ++i)
        length.push_back(length.back() + (path[i] - path[i - 1]).norm());
    Points out;
    for (std::size_t k = 0, i = 0; k < mean_points; ++k) {
        const double at = length.back() * static_cast<double>(k) / (mean_points - 1);
        while (i + 2 < path.size() && length[i + 1] < at) ++i;
        const double step = length[i + 1] - length[i];
        out.push_back(step > 0 ? path[i] + (path[i + 1] - path[i]) * std::min(1.0, (at - length[i]) / step)
                               : path[i]);
    }
    return out;
}

/// The paths of finished trials; all paths when there are none, as in a world without trials.
std::vector<Path> counted(std::vector<Path> paths) {
    const auto finished = [](const Path& p) { return p.finished; };
    if (std::ranges::any_of(paths, finished)) std::erase_if(paths, std::not_fn(finished));
    return paths;
}

/// The mean of the paths of finished trials from each start pose.
std::vector<Points> mean_paths(const bug::World& world, const std::vector<Path>& paths) {
    const auto starts = world.start_poses();
    if (starts.empty()) return {};
    std::vector<Points> sums(starts.size(), Points(mean_points, Eigen::Vector2d::Zero()));
    std::vector<double> counts(starts.size());
    for (const auto& p : paths) {
        if (p.points.size() < 2 || !p.finished) continue;
        const Pose2 start{p.points[0].x(), p.points[0].y(), 0};
        const auto n = static_cast<std::size_t>(start_number(starts, start) - 1);
        const Points points = resampled(p.points);
        for (std::size_t i = 0; i < mean_points; ++i) sums[n][i] += points[i];
        ++counts[n];
    }
    std::vector<Points> out;
    for (std::size_t n = 0; n < sums.size(); ++n) {
        if (counts[n] == 0) continue;
        for (auto& point : sums[n]) point /= counts[n];
        out.push_back(std::move(sums[n]));
    }
    return out;
}

/// The share of the paths that crossed each cell of the view, row by row from the top.
std::vector<double> shares(const std::vector<Path>& paths, const WorldMap::Box& view, int columns, int rows) {
    std::vector<double> out(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    double count = 0;
    for (const auto& p : paths) {
        if (p.points.empty()) continue;
        ++count;
        std::set<std::size_t> crossed;
        for (const auto& point : p.points) {
            const double x = (point.x() - view.min().x()) / view.sizes().x() * columns,
                         y = (view.max().y() - point.y()) / view.sizes().y() * rows;
            if (x >= 0 && x < columns && y >= 0 && y < rows)
                crossed.insert(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                               static_cast<std::size_t>(x));
        }
        for (const std::size_t i : crossed) ++out[i];
    }
    for (double& v : out) v /= std::max(count, 1.0);
    return out;
}

/// Colours the cells that were crossed.
void draw_shares(Canvas& canvas, const std::vector<double>& crossed, const Box& box, int columns, int rows,
                 const ColourScale& scale) {
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double v = crossed[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                     static_cast<std::size_t>(column)];
            if (v == 0) continue;
            cairo_rectangle(canvas.cairo(), box.x + box.width * column / columns,
                            box.y + box.height * row / rows, box.width / columns, box.height / rows);
            canvas.fill(scale(v), 0.85);
        }
}

void draw_path(Canvas& canvas, const WorldMap& map, const Points& path) {
    for (const bool halo : {true, false}) {
        for (const auto& p : path) cairo_line_to(canvas.cairo(), map.px(p.x()), map.py(p.y()));
        canvas.stroke(halo ? black : white, halo ? 4.2 : 2.4);
    }
}

/// The name of a condition in lines of at most `width` pixels, broken between parameters. Of a longer
/// parameter the end remains, which has the value.
std::vector<std::string> name_lines(Canvas& canvas, const std::string& name, double width) {
    std::vector<std::string> out;
    for (std::size_t from = 0; from < name.size();) {
        const auto comma = std::min(name.find(", ", from), name.size());
        std::string part = name.substr(from, comma - from);
        from = comma + 2;
        if (!out.empty() && canvas.width_of(out.back() + ", " + part, name_text) <= width) {
            out.back() += ", " + part;
            continue;
        }
        out.push_back(canvas.fitted_end(part, name_text, width));
    }
    return out;
}

}  // namespace

Picture occupancy_plot(const bug::World& world, const std::vector<PathsOf>& conditions,
                       const std::string& title, const std::string& part) {
    struct Panel {
        std::vector<std::string> name;
        std::string count;
        std::shared_ptr<const WorldMap> map;
        std::vector<double> crossed;
        std::vector<Points> means;
        Box box;
    };
    Eigen::AlignedBox2d all;
    for (const auto& c : conditions)
        for (const auto& p : c.paths)
            for (const auto& point : p.points) all.extend(point);
    const bool one = conditions.size() == 1;
    const double side = one ? 640 : 300;
    const WorldMap first(world, all, side, 0, 0);
    Measure measure;
    std::vector<std::vector<std::string>> names;
    std::size_t max_lines_of_name = 0;
    for (const auto& c : conditions) {
        names.push_back(name_lines(measure.canvas(), c.name, first.width() + 40));
        max_lines_of_name = std::max(max_lines_of_name, names.back().size());
    }
    const double heading_of_panel = one ? 0 : 20 + name_line * static_cast<double>(max_lines_of_name),
                 top = occupancy_top + heading_of_panel;
    const auto& view = first.view();
    const double step_x = occupancy_left + first.width() + 12,
                 step_y = first.height() + occupancy_bottom + 4 + heading_of_panel;
    // The number of columns gives the sheet an aspect ratio of about 4 to 3.
    const auto n = static_cast<double>(conditions.size());
    const auto across =
        static_cast<std::size_t>(std::clamp(std::round(std::sqrt(n * step_y / step_x * 4 / 3)), 1.0, n));
    const double cell = view.sizes().maxCoeff() / (one ? 75 : 50);
    const int columns = std::max(1, static_cast<int>(view.sizes().x() / cell + 0.5)),
              rows = std::max(1, static_cast<int>(view.sizes().y() / cell + 0.5));
    ColourScale scale;
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const auto paths = counted(conditions[i].paths);
        const double x = occupancy_left + static_cast<double>(i % across) * step_x,
                     y = top + static_cast<double>(i / across) * step_y;
        panels.push_back({names[i],
                          fmt::format("{} path{}", paths.size(), paths.size() == 1 ? "" : "s"),
                          std::make_shared<const WorldMap>(world, all, side, x, y),
                          shares(paths, view, columns, rows),
                          mean_paths(world, paths),
                          {x, y, first.width(), first.height()}});
        for (const double v : panels.back().crossed) scale.include(v);
    }
    const double right = panels[std::min(across, panels.size()) - 1].box.right(),
                 bottom = panels.back().box.bottom();
    const std::string subtitle = fmt::format(
        "{}{}{}cells of {:.2g} m{}", part, part.empty() ? "" : "; ", one ? panels[0].count + "; " : "", cell,
        panels[0].means.empty() ? "" : "; white: the mean path from each start");
    const double width =
        std::max({right + 22 + 16 + colour_bar_labels, width_of_titles(measure.canvas(), title, subtitle)});
    return {width, bottom + occupancy_bottom, [=](Canvas& canvas) {
                draw_titles(canvas, title, subtitle);
                for (const auto& p : panels) {
                    double at = p.box.y - 7 - name_line * static_cast<double>(p.name.size());
                    for (const auto& line : p.name)
                        if (!one) canvas.text(p.box.x, at, line, name_text), at += name_line;
                    if (!one) canvas.text(p.box.x, p.box.y - 7, p.count, 11, 0, grey);
                    cairo_save(canvas.cairo());
                    clip(canvas, p.box);
                    p.map->draw_ground(canvas);
                    draw_shares(canvas, p.crossed, p.box, columns, rows, scale);
                    p.map->draw_movable_objects(canvas);
                    p.map->draw_marks(canvas);
                    for (const auto& path : p.means) draw_path(canvas, *p.map, path);
                    p.map->draw_targets(canvas);
                    cairo_restore(canvas.cairo());
                    draw_axes(canvas, p.map->axes(), {"x (m)"}, {"y (m)"});
                }
                const Box bar{right + 22, top, 16, panels[0].box.height};
                draw_colour_bar(canvas, scale, bar, "share of the paths");
            }};
}

}  // namespace forage::plot
