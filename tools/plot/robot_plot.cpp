#include "tools/plot/robot_plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "bug_interface/simulation/world_queries.h"
#include "core/base/number.h"
#include "tools/plot/axes.h"
#include "tools/plot/world_map.h"

namespace forage::plot {
namespace {

constexpr Colour body_colour{0.80, 0.84, 0.90}, body_edge{0.25, 0.32, 0.45}, camera_colour{0.15, 0.45, 0.75},
    gripper_ray{0.35, 0.60, 0.30};
constexpr double small = 11;

using bug::RangePurpose;

std::string short_number(double v) { return rounded(v, 2); }

Colour colour_of(const bug::RangeSensor& s) {
    const auto purpose = s.purpose();
    return purpose == RangePurpose::light     ? light_ray
           : purpose == RangePurpose::gripper ? gripper_ray
                                              : near_ray;
}
std::string_view title_of(const bug::RangeSensor& s) { return s.use() ? s.use()->title : s.name; }

/// Draws the robot's disc, with its heading upwards.
void draw_disc(Canvas& canvas, double x, double y, double radius) {
    canvas.colour(body_colour);
    canvas.circle(x, y, radius);
    cairo_fill_preserve(canvas.cairo());
    canvas.stroke(body_edge, 1.5);
    canvas.line(x, y, x, y - radius, body_edge, 1.5);
}

void draw_title(Canvas& canvas, const Box& box, const std::string& title, const std::string& text) {
    canvas.text(box.x, box.y - 22, title, 14, 0, black, true);
    canvas.text(box.x, box.y - 6, text, small, 0, grey);
}

/// The rays from above. Every cell has its number and its angle.
void draw_rays(Canvas& canvas, const Box& box, const bug::RobotSensors& sensors, double radius) {
    const double x = box.x + box.width / 2, y = box.y + box.height / 2;
    double reach = 0.5;
    const bug::RangeSensor* widest = nullptr;
    for (const auto& s : sensors.range_sensors())
        if (s.max_range > reach) reach = s.max_range, widest = &s;
    const double outer = box.width / 2 - 36, scale = outer / reach;
    const auto point = [&](double angle, double r) {  // the robot looks upwards
        return std::pair(x - r * std::sin(angle), y - r * std::cos(angle));
    };
    for (double r = 1; r <= reach; ++r) {
        canvas.dashes(4, 4);
        canvas.circle(x, y, r * scale);
        canvas.stroke(pale, 2);
        canvas.dashes(0, 0);
        canvas.text(x, y + r * scale - 4, short_number(r) + " m", small, 0.5, grey);
    }
    for (const double width : {3.0, 1.0})  // the wide light rays lie below the narrow ones
        for (const auto& s : sensors.range_sensors()) {
            if ((s.purpose() == RangePurpose::light) != (width > 2)) continue;
            const Eigen::Vector3d at = (sensors.link_pose() * s.pose).translation();
            for (int k = 0; k < s.rays; ++k) {
                const auto [x0, y0] = point(s.cell_angle(k), s.min_range * scale);
                const auto [x1, y1] = point(s.cell_angle(k), s.max_range * scale);
                canvas.segment(x0 - at.y() * scale, y0 - at.x() * scale, x1 - at.y() * scale,
                               y1 - at.x() * scale);
            }
            canvas.stroke(colour_of(s), width);
        }
    draw_disc(canvas, x, y, radius * scale);
    double legend = box.y + box.height + 4;
    for (const auto& s : sensors.range_sensors()) {
        canvas.line(box.x, legend - 4, box.x + 24, legend - 4, colour_of(s), 3);
        canvas.text(
            box.x + 32, legend,
            fmt::format("{}: {} to {} m", title_of(s), rounded(s.min_range, 4), short_number(s.max_range)),
            small);
        legend += 16;
    }
    if (!widest) return;
    for (int k = 0; k < widest->rays; ++k) {
        const auto [tx, ty] = point(widest->cell_angle(k), outer + 20);
        canvas.text(tx, ty, std::to_string(k + 1), 12, 0.5, black, true);
        canvas.text(tx, ty + 11, fmt::format("{:+.1f}°", widest->cell_angle(k) * 180 / std::numbers::pi), 9,
                    0.5, grey);
    }
}

/// The path of a robot with this command, which starts upwards at (x, y), with an arrow.
void draw_command(Canvas& canvas, double x, double y, const bug::MotorCommand& command, double length) {
    cairo_t* c = canvas.cairo();
    if (command.forward == 0 && command.turn == 0) {
        canvas.circle(x, y, 2.5);
        return canvas.fill(body_edge);
    }
    constexpr int steps = 24;
    double angle = M_PI / 2;
    const bool on_the_spot = command.forward == 0;
    double at_x = x, at_y = y + (on_the_spot ? 0 : command.forward * length / 2);
    if (on_the_spot) at_x = x + 0.5 * length, angle = command.turn > 0 ? M_PI / 2 : -M_PI / 2;
    if (on_the_spot && command.turn < 0) at_x = x - 0.5 * length, angle = M_PI / 2;
    cairo_move_to(c, at_x, at_y);
    const double turn = command.turn * (on_the_spot ? 4.5 : 1.6);
    const double step =
        on_the_spot ? std::abs(turn) * 0.5 * length / steps : command.forward * length / steps;
    for (int i = 0; i < steps; ++i) {
        angle += turn / steps;
        at_x += step * std::cos(angle), at_y -= step * std::sin(angle);
        cairo_line_to(c, at_x, at_y);
    }
    const double direction = command.forward < 0 ? angle + M_PI : angle;
    for (const double side : {2.6, -2.6}) {
        cairo_move_to(c, at_x, at_y);
        cairo_rel_line_to(c, 5 * std::cos(direction + side), -5 * std::sin(direction + side));
    }
    canvas.stroke(body_edge, 1.4);
}

void draw_motor(Canvas& canvas, const Box& box) {
    cairo_t* c = canvas.cairo();
    constexpr int side = 9;
    const double size = box.width / side;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            std::vector<double> cells(side * side);
            cells[static_cast<std::size_t>(row * side + column)] = 1;
            const auto command = bug::decode_motor(cells, side, side, 1, 1);
            const double x = box.x + column * size, y = box.y + row * size;
            cairo_rectangle(c, x, y, size, size);
            canvas.stroke(pale);
            draw_command(canvas, x + size / 2, y + size / 2, command, 0.62 * size);
            if (column == 0) {
                canvas.text(box.x - 6, y + size / 2 + 4, short_number(command.forward), small, 1);
                canvas.text(box.right() + 8, y + size / 2 + 4, std::to_string(row + 1), small, 0, grey);
            }
            if (row == side - 1) {
                canvas.text(x + size / 2, box.bottom() + 15, short_number(command.turn), small, 0.5);
                canvas.text(x + size / 2, box.y - 4, std::to_string(column + 1), small, 0.5, grey);
            }
        }
    canvas.text(box.x + box.width / 2, box.bottom() + 30, "left turn / rotSpeed", small, 0.5);
    canvas.text_upwards(box.x - 46, box.y + box.height / 2, "forward / transSpeed", small);
}

/// The points where the camera's top and bottom rows meet the floor, and those between them.
struct Footprint {
    std::vector<Eigen::Vector2d> left, right;  ///< from the bottom row upwards, m
    std::vector<int> rows;                     ///< from 1
    double far = 0;                            ///< distance of the last row, m
};

Footprint footprint_of(const bug::World& world, const bug::RobotSensors& sensors) {
    Footprint out;
    if (!sensors.camera_sensor()) return out;
    const auto& s = *sensors.camera_sensor();
    const bug::Camera camera(s, sensors.link_pose(), world.scene());
    for (int y = s.height - 1; y >= 0; --y) {
        const auto left = camera.floor_point(0, y), right = camera.floor_point(s.width - 1, y);
        if (!left || !right || left->x() > 4) break;
        out.left.push_back(*left), out.right.push_back(*right), out.rows.push_back(y + 1);
        out.far = left->x();
    }
    return out;
}

/// The robot from its right side.
void draw_side(Canvas& canvas, const Box& box, const bug::World& world, std::size_t robot,
               const Footprint& seen) {
    cairo_t* c = canvas.cairo();
    const auto& r = world.robot(robot);
    const bug::RobotSensors& sensors = r.sensors;
    const double right_end = std::max(0.75, std::min(seen.far, 1.2) + 0.1), left_end = -0.3;
    double highest = 0.2;
    if (const auto& s = sensors.camera_sensor()) highest = (sensors.link_pose() * s->pose).translation().z();
    for (const auto& s : sensors.range_sensors())
        highest = std::max(highest, (sensors.link_pose() * s.pose).translation().z());
    const double floor = box.bottom() - 24;
    const double scale = std::min(box.width / (right_end - left_end), (box.height - 44) / highest);
    const auto px = [&](double x) { return box.x + (x - left_end) * scale; };
    const auto py = [&](double z) { return floor - z * scale; };
    const auto& collisions = bug::robot_link(*bug::find_model(world.description(), r.name))->collisions;
    const double height = collisions.empty() ? 0.2 : collisions.front().shape.size.z();
    canvas.fill(px(-r.body.radius), py(height), 2 * r.body.radius * scale, height * scale, body_colour);
    cairo_rectangle(c, px(-r.body.radius), py(height), 2 * r.body.radius * scale, height * scale);
    canvas.stroke(body_edge, 1.5);
    canvas.line(box.x, floor, px(right_end), floor, black, 1.5);
    if (const auto& s = sensors.camera_sensor(); s && !seen.left.empty()) {
        const Eigen::Vector3d eye = (sensors.link_pose() * s->pose).translation();
        canvas.segment(px(eye.x()), py(eye.z()), px(seen.left.front().x()), floor);
        cairo_line_to(c, px(std::min(seen.far, right_end)), floor);
        cairo_close_path(c);
        canvas.fill(camera_colour, 0.18);
        canvas.circle(px(eye.x()), py(eye.z()), 3.5);
        canvas.fill(camera_colour);
        canvas.text(px(eye.x()) - 6, py(eye.z()) - 7, fmt::format("camera {} m", rounded(eye.z(), 3)), small,
                    1, camera_colour);
        for (const double x : {seen.left.front().x(), seen.far})
            if (x < right_end) {
                canvas.line(px(x), floor, px(x), floor + 5, black);
                canvas.text(px(x), floor + 17, short_number(x) + " m", small, 0.5);
            }
    }
    canvas.line(px(0), floor, px(0), floor + 5, black);
    canvas.text(px(0), floor + 17, "0", small, 0.5);
    for (const auto& s : sensors.range_sensors()) {
        const Eigen::Vector3d at = (sensors.link_pose() * s.pose).translation();
        const double end = std::min(at.x() + s.max_range, right_end);
        canvas.line(px(at.x() + s.min_range), py(at.z()), px(end), py(at.z()), colour_of(s), 2.2);
        canvas.text(px(right_end), py(at.z()) - 4, fmt::format("{} {} m", title_of(s), rounded(at.z(), 3)),
                    small, 1, black);
    }
}

/// The floor that the camera sees, from above, with the robot's heading upwards.
void draw_footprint(Canvas& canvas, const Box& box, const Footprint& seen, double radius) {
    cairo_t* c = canvas.cairo();
    if (seen.left.empty()) return canvas.text(box.x, box.y + 20, "no camera", small, 0, grey);
    const double scale = std::min((box.height - 8) / (seen.far + 0.03),
                                  (box.width / 2 - 50) / std::max(radius, seen.left.back().y()));
    const double x0 = box.x + box.width / 2, y0 = box.bottom();
    const auto px = [&](double left) { return x0 - left * scale; };
    const auto py = [&](double ahead) { return y0 - ahead * scale; };
    cairo_save(c);
    clip(canvas, box);
    draw_disc(canvas, x0, y0, radius * scale);
    cairo_restore(c);
    canvas.segment(px(seen.left.front().y()), py(seen.left.front().x()), px(seen.left.back().y()),
                   py(seen.far));
    cairo_line_to(c, px(seen.right.back().y()), py(seen.far));
    cairo_line_to(c, px(seen.right.front().y()), py(seen.right.front().x()));
    cairo_close_path(c);
    canvas.fill(camera_colour, 0.18);
    double last = y0;
    for (std::size_t i = 0; i < seen.rows.size(); ++i) {
        const double y = py(seen.left[i].x());
        if (i > 0 && i + 1 < seen.rows.size() && (last - y < 13 || y - py(seen.far) < 13)) continue;
        last = y;
        canvas.line(px(seen.left[i].y()), y, px(seen.right[i].y()), y, camera_colour, 1);
        canvas.text(px(seen.left[i].y()) - 6, y + 4, fmt::format("row {}", seen.rows[i]), small, 1);
        canvas.text(px(seen.right[i].y()) + 6, y + 4, short_number(seen.left[i].x()) + " m", small);
    }
}

}  // namespace

Picture robot_plot(const bug::World& world, std::size_t robot) {
    constexpr double rays = 560, motor = 300;
    static constexpr Box ray_box{24, 84, rays, rays}, motor_box{24 + rays + 84, 104, motor, motor},
        side_box{24, 744, rays, 190}, camera_box{24 + rays + 48, 516, motor + 60, 418};
    return {camera_box.right() + 24, camera_box.bottom() + 24, [&world, robot](Canvas& canvas) {
                const auto& r = world.robot(robot);
                const Footprint seen = footprint_of(world, r.sensors);
                canvas.text(24, 30, "Robot " + r.name, 17, 0, black, true);
                draw_title(canvas, ray_box, "Range sensors from above",
                           "The cells of the groups and their angles; the robot heads up, positive angles "
                           "are to its left.");
                draw_rays(canvas, ray_box, r.sensors, r.body.radius);
                draw_title(canvas, {motor_box.x, motor_box.y - 14, 0, 0}, "Motor group",
                           "The most active cell is the velocity; the robot heads up.");
                draw_motor(canvas, motor_box);
                draw_title(canvas, side_box, "From the side", "Heights of the sensors above the floor.");
                draw_side(canvas, side_box, world, robot, seen);
                draw_title(canvas, camera_box, "Camera from above",
                           "Rows of pixels on the floor; distances from the robot's middle.");
                draw_footprint(canvas, camera_box, seen, r.body.radius);
            }};
}

}  // namespace forage::plot
