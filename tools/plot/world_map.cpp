#include "tools/plot/world_map.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bug_interface/world/png.h"
#include "tools/plot/axes.h"

namespace forage::plot {
namespace {

using bug::ShapeKind;

struct Free {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;

constexpr Colour near_ray{0.95, 0.25, 0.15}, light_ray{0.95, 0.75, 0.05};

double top_of(const bug::DrawnSolid& d) { return d.solid.pose.translation().z() + d.solid.size.z() / 2; }

void dashed(cairo_t* c, double on, double off) {
    const double dash[] = {on, off};
    cairo_set_dash(c, dash, 2, 0);
}

}  // namespace

WorldMap::WorldMap(const bug::World& world, const Box& extra, double pixels, double left, double top)
    : world_(world), left_(left), top_(top) {
    Box box = extra;
    if (const auto plan = world.reset_plan()) {
        box.extend(plan->bounds);
        for (const auto& s : plan->starts) box.extend(Eigen::Vector2d(s.x, s.y));
    } else {
        for (const auto& d : world.drawing()) {
            if (d.solid.size.z() < 0.02) continue;  // paint may reach under the walls
            const Eigen::Vector2d at = d.solid.pose.translation().head<2>();
            const Eigen::Vector2d half = (d.solid.pose.linear().cwiseAbs() * d.solid.size / 2).head<2>();
            box.extend(Eigen::Vector2d(at - half)).extend(Eigen::Vector2d(at + half));
        }
    }
    for (const auto& t : world.targets()) box.extend(t);
    for (std::size_t i = 0; i < world.bugs(); ++i)
        box.extend(Eigen::Vector2d(world.pose(i).x, world.pose(i).y));
    if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
    const double margin = std::max(0.04 * box.sizes().maxCoeff(), 0.5);
    view_ = Box(box.min().array() - margin, box.max().array() + margin);
    scale_ = pixels / view_.sizes().maxCoeff();
}

void WorldMap::draw_ground(Canvas& canvas) const {
    canvas.fill(left_, top_, width(), height(), {0.5, 0.5, 0.5});
    for (const auto& floor : world_.floors()) draw_floor(canvas, floor);
    auto solids = bug::drawing_of(world_.description());
    std::stable_sort(solids.begin(), solids.end(),
                     [](const auto& a, const auto& b) { return top_of(a) < top_of(b); });
    for (const auto& d : solids) draw_solid(canvas, d);
}

void WorldMap::draw_loose(Canvas& canvas) const {
    const auto still = bug::drawing_of(world_.description()).size();
    const auto all = world_.drawing();
    for (std::size_t i = still; i < all.size(); ++i) draw_solid(canvas, all[i]);
}

void WorldMap::draw_floor(Canvas& canvas, const bug::Floor& floor) const {
    cairo_t* c = canvas.cairo();
    bug::Image image;
    try {
        image = bug::read_png(floor.texture);
    } catch (const std::exception&) {
        return;  // the picture shows the rest all the same; the camera reports a floor that cannot be read
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
    cairo_save(c);
    cairo_translate(c, px(floor.x - floor.size_x / 2), py(floor.y + floor.size_y / 2));
    cairo_scale(c, floor.size_x * scale_ / image.width, floor.size_y * scale_ / image.height);
    cairo_set_source_surface(c, texture.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_GOOD);
    cairo_paint(c);
    cairo_restore(c);
}

void WorldMap::draw_solid(Canvas& canvas, const bug::DrawnSolid& d) const {
    cairo_t* c = canvas.cairo();
    const Eigen::Vector3d at = d.solid.pose.translation();
    cairo_save(c);
    cairo_translate(c, px(at.x()), py(at.y()));
    cairo_rotate(c, -bug::yaw_of(d.solid.pose));
    const double w = d.solid.size.x() * scale_, h = d.solid.size.y() * scale_;
    if (d.solid.kind == ShapeKind::box)
        cairo_rectangle(c, -w / 2, -h / 2, w, h);
    else
        cairo_arc(c, 0, 0, w / 2, 0, 2 * M_PI);
    cairo_set_source_rgb(c, d.colour[0], d.colour[1], d.colour[2]);
    cairo_fill(c);
    cairo_restore(c);
}

void WorldMap::draw_marks(Canvas& canvas) const {
    cairo_t* c = canvas.cairo();
    const auto plan = world_.reset_plan();
    if (!plan) return;
    dashed(c, 6, 5);
    cairo_set_line_width(c, 1);
    cairo_set_source_rgb(c, 0.65, 0.65, 0.65);
    cairo_rectangle(c, px(plan->bounds.min().x()), py(plan->bounds.max().y()),
                    plan->bounds.sizes().x() * scale_, plan->bounds.sizes().y() * scale_);
    cairo_stroke(c);
    cairo_set_dash(c, nullptr, 0, 0);
    for (const auto& s : plan->starts) {  // an arrow in the robot's direction
        cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
        cairo_set_line_width(c, 2);
        const double x = px(s.x), y = py(s.y), l = 0.17 * scale_;
        cairo_move_to(c, x - l * std::cos(s.yaw), y + l * std::sin(s.yaw));
        cairo_line_to(c, x + l * std::cos(s.yaw), y - l * std::sin(s.yaw));
        for (const double turn : {2.5, -2.5}) {
            cairo_move_to(c, x + l * std::cos(s.yaw), y - l * std::sin(s.yaw));
            cairo_rel_line_to(c, 0.7 * l * std::cos(s.yaw + turn), -0.7 * l * std::sin(s.yaw + turn));
        }
        cairo_stroke(c);
    }
}

void WorldMap::draw_targets(Canvas& canvas) const {
    cairo_t* c = canvas.cairo();
    for (const auto& t : world_.targets()) {
        cairo_set_source_rgb(c, 1, 1, 1);
        cairo_set_line_width(c, 1.5);
        dashed(c, 3, 3);
        cairo_arc(c, px(t.x()), py(t.y()), bug::Trial::reach * scale_, 0, 2 * M_PI);
        cairo_stroke(c);
        cairo_set_dash(c, nullptr, 0, 0);
    }
}

/// Proximity rays as far as they see something; light rays to the light.
void WorldMap::draw_rays(Canvas& canvas, std::size_t robot) const {
    cairo_t* c = canvas.cairo();
    const auto& pose = world_.pose(robot);
    const auto& seen = world_.snapshot(robot);
    for (const bug::RangeSensor& sensor : world_.robot(robot).range_sensors) {
        const bool light = sensor.name == "laser_target";
        const auto& cells = light ? seen.target : seen.proximity;
        if ((!light && sensor.name != "laser") || cells.size() != static_cast<std::size_t>(sensor.rays))
            continue;
        canvas.colour(light ? light_ray : near_ray, 0.9);
        cairo_set_line_width(c, light ? 1.8 : 1.1);
        const double n = std::max(1, sensor.rays - 1);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cells[k] < 0.03) continue;  // noise of a ray that meets nothing
            const double angle = pose.yaw + sensor.last_angle -
                                 static_cast<double>(k) * (sensor.last_angle - sensor.first_angle) / n;
            const double range = sensor.max_range * (1 - cells[k]);
            const auto to = [&](double r) {
                return std::pair(px(pose.x + r * std::cos(angle)), py(pose.y + r * std::sin(angle)));
            };
            const auto [x0, y0] = to(sensor.min_range);
            const auto [x1, y1] = to(range);
            cairo_move_to(c, x0, y0), cairo_line_to(c, x1, y1);
        }
        cairo_stroke(c);
    }
}

void WorldMap::draw_robot(Canvas& canvas, std::size_t robot, bool rays) const {
    cairo_t* c = canvas.cairo();
    if (rays) draw_rays(canvas, robot);
    const bug::Stage& stage = world_.stage();
    for (const bool gripper : {true, false})
        for (const bug::MovingSight& sight : world_.moving_sights()) {
            if (sight.body != robot || sight.of_body == gripper) continue;
            bug::Solid solid = sight.visual.solid;
            solid.pose = sight.at(stage);
            draw_solid(canvas, {solid, sight.visual.material.diffuse});
        }
    const auto& pose = world_.pose(robot);
    const double r = world_.robot(robot).body.radius * scale_, x = px(pose.x), y = py(pose.y);
    canvas.colour(black);
    cairo_set_line_width(c, 1.2);
    cairo_arc(c, x, y, r, 0, 2 * M_PI);
    cairo_stroke(c);
    canvas.colour(white);
    cairo_set_line_width(c, std::max(1.5, r / 5));
    cairo_move_to(c, x, y), cairo_line_to(c, x + r * std::cos(pose.yaw), y - r * std::sin(pose.yaw));
    cairo_stroke(c);
}

Picture world_plot(const bug::World& world, const std::string& title) {
    constexpr double left = 62, top = 34, right = 24, bottom = 52;
    const WorldMap map(world, {}, 800, left, top);
    return {left + std::floor(map.width()) + right, top + std::floor(map.height()) + bottom,
            [map, &world, title](Canvas& canvas) {
                cairo_t* c = canvas.cairo();
                cairo_save(c);
                cairo_rectangle(c, left, top, map.width(), map.height());
                cairo_clip(c);
                map.draw_ground(canvas);
                map.draw_marks(canvas);
                map.draw_loose(canvas);
                for (std::size_t i = 0; i < world.bugs(); ++i) map.draw_robot(canvas, i, true);
                map.draw_targets(canvas);
                const auto names = world.bug_names();
                for (std::size_t i = 0; i < world.bugs(); ++i) {
                    const auto& at = world.pose(i);
                    const double x = map.px(at.x),
                                 y = map.py(at.y) - world.robot(i).body.radius * map.scale() - 5;
                    const double wide = canvas.width_of(names[i], 11);
                    canvas.fill(x - wide / 2 - 2, y - 11, wide + 4, 14, white);
                    canvas.text(x, y, names[i], 11, 0.5);
                }
                cairo_restore(c);
                plot::draw_axes(canvas,
                                {{left, top, map.width(), map.height()},
                                 {map.view().min().x(), map.view().max().x()},
                                 {map.view().min().y(), map.view().max().y()}},
                                {"x (m)"}, {"y (m)"});
                canvas.text(12, 22, title, 15, 0, black, true);
            }};
}

}  // namespace forage::plot
