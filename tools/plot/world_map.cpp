#include "tools/plot/world_map.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <vector>

#include "bug_interface/sensing/scene.h"
#include "tools/plot/axes.h"
#include "tools/plot/cairo_handle.h"
#include "tools/plot/world_labels.h"

namespace forage::plot {
namespace {

using bug::ShapeKind;

double top_of(const bug::DrawnSolid& d) { return d.solid.pose.translation().z() + d.solid.size.z() / 2; }

/// A floor's picture, reduced by averaging blocks of n x n pixels. Blocks at the right and lower edges may be
/// smaller.
CairoSurface picture_of(const bug::FloorTexture& floor, int n) {
    const int width = (floor.width() + n - 1) / n, height = (floor.height() + n - 1) / n;
    CairoSurface out(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    if (cairo_surface_status(out.get()) != CAIRO_STATUS_SUCCESS) return out;  // too large for cairo
    auto* data = cairo_image_surface_get_data(out.get());
    const int stride = cairo_image_surface_get_stride(out.get());
    // The sums of n rows, per column. A word has the sum of blue in its high half and that of red in its low
    // half.
    std::vector<std::uint32_t> red_blue(static_cast<std::size_t>(floor.width())), green(red_blue.size());
    for (int y = 0; y < height; ++y) {
        const int rows = std::min(n, floor.height() - y * n);
        std::ranges::fill(red_blue, 0u), std::ranges::fill(green, 0u);
        for (int row = y * n; row < y * n + rows; ++row) {
            const std::uint32_t* in = floor.row(row);
            for (std::size_t i = 0; i < green.size(); ++i)
                red_blue[i] += in[i] & 0xff00ffu, green[i] += in[i] >> 8 & 255u;
        }
        auto* to = reinterpret_cast<std::uint32_t*>(data + y * stride);
        for (int x = 0; x < width; ++x) {
            const int columns = std::min(n, floor.width() - x * n);
            std::uint32_t sums[3] = {};
            for (auto i = static_cast<std::size_t>(x * n); i < static_cast<std::size_t>(x * n + columns); ++i)
                sums[0] += red_blue[i] & 0xffffu, sums[1] += green[i], sums[2] += red_blue[i] >> 16;
            const auto count = static_cast<std::uint32_t>(rows * columns);
            to[x] = sums[0] / count << 16 | sums[1] / count << 8 | sums[2] / count;
        }
    }
    cairo_surface_mark_dirty(out.get());
    return out;
}

/// The floors with pictures; none when one cannot be read, which the camera reports.
std::vector<const bug::FloorSurface*> floors_of(const bug::World& world) {
    std::vector<const bug::FloorSurface*> out;
    try {
        for (const auto& floor : world.scene()->floors())
            if (floor.texture.width() * floor.texture.height() > 1) out.push_back(&floor);
    } catch (const std::exception&) {
        out.clear();
    }
    return out;
}

}  // namespace

bool has_homes(const bug::World& world) {
    const auto& models = world.description().models;
    return !world.game().empty() ||
           std::ranges::any_of(models, [](const auto& m) { return m.name == "Home_A"; });
}

WorldMap::WorldMap(const bug::World& world, const Box& extra, double pixels, double left, double top)
    : world_(world), left_(left), top_(top) {
    Box box = extra, near;  // solids far outside the bounds are not shown
    const auto plan = world.reset_plan();
    if (plan) {
        box.extend(plan->bounds);
        for (const auto& s : plan->starts) box.extend(Eigen::Vector2d(s.x, s.y));
        near = Box(box.min().array() - 1, box.max().array() + 1);
    }
    for (const auto& d : world.drawing()) {
        if (d.solid.size.z() < 0.02) continue;  // paint may extend below the walls
        const Eigen::Vector2d at = d.solid.pose.translation().head<2>();
        const Eigen::Vector2d half = (d.solid.pose.linear().cwiseAbs() * d.solid.size / 2).head<2>();
        const Box solid(at - half, at + half);
        if (!plan)
            box.extend(solid);
        else if (near.intersects(solid))
            box.extend(near.intersection(solid));
    }
    for (const auto& t : world.targets()) box.extend(t);
    for (std::size_t i = 0; i < world.bugs(); ++i)
        box.extend(Eigen::Vector2d(world.pose(i).x, world.pose(i).y));
    if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
    const double margin = std::max(0.04 * box.sizes().maxCoeff(), 0.5);
    view_ = Box(box.min().array() - margin, box.max().array() + margin);
    scale_ = pixels / view_.sizes().maxCoeff();
}

WorldMap WorldMap::with_floors(const bug::World& world, double pixels) {
    constexpr double max_distance = 1.5;  // m
    WorldMap map(world, {}, pixels, 0, 0);
    if (!world.reset_plan()) return map;  // what lies outside of its walls is not reached
    const Box around(map.view_.min().array() - max_distance, map.view_.max().array() + max_distance);
    for (const auto* floor : floors_of(world)) {
        const Eigen::Vector2d at(floor->pose.x, floor->pose.y);
        const Eigen::Matrix2d turn = Eigen::Rotation2Dd(floor->pose.yaw).toRotationMatrix().cwiseAbs();
        const Eigen::Vector2d half = turn * Eigen::Vector2d(floor->size_x, floor->size_y) / 2;
        const Box box(at - half, at + half);
        if (around.contains(box)) map.view_.extend(box);
    }
    map.scale_ = pixels / map.view_.sizes().maxCoeff();
    return map;
}

Axes WorldMap::axes() const {
    return {{left_, top_, width(), height()},
            {view_.min().x(), view_.max().x()},
            {view_.min().y(), view_.max().y()}};
}

void WorldMap::draw_floors(Canvas& canvas) const {
    canvas.fill(left_, top_, width(), height(), {0.5, 0.5, 0.5});
    for (const auto* floor : floors_of(world_)) draw_floor(canvas, *floor);
}

void WorldMap::draw_ground(Canvas& canvas) const {
    draw_floors(canvas);
    auto solids = bug::drawing_of(world_.description());
    std::ranges::stable_sort(solids, [](const auto& a, const auto& b) { return top_of(a) < top_of(b); });
    for (const auto& d : solids) draw_solid(canvas, d);
}

void WorldMap::draw_movable_objects(Canvas& canvas) const {
    const auto still = bug::drawing_of(world_.description()).size();
    const auto all = world_.drawing();
    for (std::size_t i = still; i < all.size(); ++i) draw_solid(canvas, all[i]);
}

void WorldMap::draw_floor(Canvas& canvas, const bug::FloorSurface& floor) const {
    cairo_t* c = canvas.cairo();
    const bug::FloorTexture& texture = floor.texture;
    double pixel =
        floor.size_x * scale_ / texture.width();  // size of a pixel of the floor's picture on the map
    const double aspect = floor.size_y / texture.height() / (floor.size_x / texture.width());
    // On the screen, pixels that are too small to be visible are averaged first, which is faster than cairo.
    // SVG and PDF files keep all pixels, as users can enlarge them.
    const bool on_screen = cairo_surface_get_type(cairo_get_target(c)) == CAIRO_SURFACE_TYPE_IMAGE;
    const int n =
        on_screen ? static_cast<int>(std::lround(1 / std::clamp(pixel, 0.01, 1.0))) : 1;  // at most 100
    pixel *= n;
    const CairoSurface picture = picture_of(texture, n);
    cairo_save(c);
    cairo_translate(c, px(floor.pose.x), py(floor.pose.y));
    cairo_rotate(c, -floor.pose.yaw);
    cairo_translate(c, -floor.size_x / 2 * scale_, -floor.size_y / 2 * scale_);
    cairo_rectangle(c, 0, 0, floor.size_x * scale_, floor.size_y * scale_);
    cairo_clip(c);
    cairo_scale(c, pixel, pixel * aspect);
    cairo_set_source_surface(c, picture.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c), on_screen ? CAIRO_FILTER_BILINEAR : CAIRO_FILTER_GOOD);
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
    cairo_fill_preserve(c);
    if (d.solid.size.z() > 0.02)  // an outline, as the floor may have the same colour
        canvas.stroke(black, 0.8, 0.6);
    cairo_new_path(c);
    cairo_restore(c);
}

namespace {

/// Draws the homes of the teams and the sites of the resources.
void draw_homes(Canvas& canvas, const bug::World& world, const WorldMap& map) {
    if (!has_homes(world)) return;
    canvas.dashes(2, 4);
    for (const Pose2& at : world.game().homes()) {
        canvas.circle(map.px(at.x), map.py(at.y), bug::Game::home_radius * map.scale());
        canvas.stroke(white, 1, 0.8);
    }
    canvas.dashes(2, 3);
    if (const auto& game = world.description().game)
        for (const bug::GameSite& site : game->sites) {
            canvas.circle(map.px(site.x), map.py(site.y), 0.5 * map.scale());
            canvas.stroke(site_colour, 1.2, 0.9);
        }
    canvas.dashes(0, 0);
    draw_home_names(canvas, world, map);
}

}  // namespace

void WorldMap::draw_marks(Canvas& canvas) const {
    cairo_t* c = canvas.cairo();
    draw_homes(canvas, world_, *this);
    const auto plan = world_.reset_plan();
    if (!plan) return;
    canvas.dashes(6, 5);
    cairo_rectangle(c, px(plan->bounds.min().x()), py(plan->bounds.max().y()),
                    plan->bounds.sizes().x() * scale_, plan->bounds.sizes().y() * scale_);
    canvas.stroke(bounds_colour);
    canvas.dashes(0, 0);
    for (const auto& s : plan->starts) {  // an arrow in the direction of the start pose
        const double x = px(s.x), y = py(s.y), l = 0.17 * scale_;
        const double ahead = l * std::cos(s.yaw), up = l * std::sin(s.yaw);
        canvas.segment(x - ahead, y + up, x + ahead, y - up);
        for (const double turn : {2.5, -2.5}) {
            cairo_move_to(c, x + ahead, y - up);
            cairo_rel_line_to(c, 0.7 * l * std::cos(s.yaw + turn), -0.7 * l * std::sin(s.yaw + turn));
        }
        canvas.stroke({0.1, 0.1, 0.1}, 2);
    }
}

void WorldMap::draw_targets(Canvas& canvas) const {
    canvas.dashes(3, 3);
    for (const auto& t : world_.targets()) {
        canvas.circle(px(t.x()), py(t.y()), world_.rules().reach * scale_);
        canvas.stroke(white, 1.5);
    }
    canvas.dashes(0, 0);
}

/// Draws the rays that meet something: proximity rays to obstacles, light rays to the light.
void WorldMap::draw_rays(Canvas& canvas, std::size_t robot) const {
    const auto& pose = world_.pose(robot);
    const auto& seen = world_.robot(robot).sensors.snapshot();
    for (const bug::RangeSensor& sensor : world_.robot(robot).sensors.range_sensors()) {
        const bool light = sensor.purpose() == bug::RangePurpose::light;
        const auto& cells = light ? seen.target : seen.proximity;
        if ((!light && sensor.purpose() != bug::RangePurpose::proximity) ||
            cells.size() != static_cast<std::size_t>(sensor.rays))
            continue;
        const double nothing =
            std::max(0.03, 5 * sensor.noise / sensor.max_range);  // the noise of a ray that meets nothing
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cells[k] < nothing) continue;
            const double angle = pose.yaw + sensor.cell_angle(static_cast<int>(k));
            const double range = sensor.max_range * (1 - cells[k]);
            const auto to = [&](double r) {
                return std::pair(px(pose.x + r * std::cos(angle)), py(pose.y + r * std::sin(angle)));
            };
            const auto [x0, y0] = to(sensor.min_range);
            const auto [x1, y1] = to(range);
            canvas.segment(x0, y0, x1, y1);
        }
        canvas.stroke(light ? light_ray : near_ray, light ? 1.8 : 1.1, 0.9);
    }
}

void WorldMap::draw_robot(Canvas& canvas, std::size_t robot, bool rays) const {
    if (rays) draw_rays(canvas, robot);
    const bug::BodyPoses& poses = world_.body_poses();
    for (const bool gripper : {true, false})
        for (const bug::MovingVisual& moving : world_.moving_visuals()) {
            if (moving.body != robot || moving.of_body_link == gripper) continue;
            bug::Solid solid = moving.visual.solid;
            solid.pose = moving.at(poses);
            draw_solid(canvas, {solid, moving.visual.material.diffuse});
        }
    const auto& pose = world_.pose(robot);
    const double r = world_.robot(robot).body.radius * scale_, x = px(pose.x), y = py(pose.y);
    for (const double out : {1.2, 0.0}) {  // an outline makes the robot visible on patches of its colour
        canvas.circle(x, y, r + out);
        canvas.stroke(out > 0 ? white : black, 1.2);
    }
    canvas.line(x, y, x + r * std::cos(pose.yaw), y - r * std::sin(pose.yaw), white, std::max(1.5, r / 5));
}

Picture world_plot(const bug::World& world, const std::string& title) {
    constexpr double left = 62, top = 34, right = 24, bottom = 80;
    const WorldMap map(world, {}, 800, left, top);
    return {left + std::floor(map.width()) + right, top + std::floor(map.height()) + bottom,
            [map, &world, title](Canvas& canvas) {
                cairo_save(canvas.cairo());
                clip(canvas, map.axes().box);
                map.draw_ground(canvas);
                map.draw_marks(canvas);
                map.draw_movable_objects(canvas);
                for (std::size_t i = 0; i < world.bugs(); ++i) map.draw_robot(canvas, i, true);
                map.draw_targets(canvas);
                draw_robot_names(canvas, world, map);
                cairo_restore(canvas.cairo());
                draw_axes(canvas, map.axes(), {"x (m)"}, {"y (m)"});
                draw_legend(canvas, world, left, left + map.width(), top + map.height() + 66);
                canvas.text(12, 22, title, 15, 0, black, true);
            }};
}

}  // namespace forage::plot
