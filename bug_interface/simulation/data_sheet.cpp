#include "bug_interface/simulation/data_sheet.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "bug_interface/simulation/world_queries.h"
#include "core/base/number.h"

namespace forage::bug {
namespace {

std::string degrees(double radians, int decimals = 1) {
    return rounded(radians * 180 / std::numbers::pi, decimals);
}

std::string row(const std::vector<std::string>& cells) {
    std::string out = "|";
    for (const auto& cell : cells) out += " " + cell + " |";
    return out + "\n";
}

/// The head of a table; a table needs one also when it is empty.
std::string head(const std::vector<std::string>& cells) {
    return row(cells) + row(std::vector<std::string>(cells.size(), "---"));
}

std::string body_section(const World& world, std::size_t robot) {
    const Robot& r = world.robot(robot);
    std::string out = "## Body\n\n" + head({"", ""});
    const Link& link = *robot_link(*find_model(world.description(), r.name));
    if (!link.collisions.empty()) {
        const Collision& c = link.collisions.front();
        const double middle = (link.pose * c.pose).translation().z(), half = c.shape.size.z() / 2;
        out += row(
            {"shape", fmt::format("upright cylinder, radius {} m, {} to {} m above the floor",
                                  rounded(r.body.radius), rounded(middle - half), rounded(middle + half))});
    }
    out += row({"mass", rounded(r.body.mass) + " kg"});
    out += row({"moment of inertia", rounded(r.body.inertia) + " kg m²"});
    out += row({"friction", rounded(r.body.friction)});
    for (std::size_t i = 0; i < r.hinges.size(); ++i) {
        const auto& hinge = r.hinges[i];
        out +=
            row({"gripper", fmt::format("hinge `{}`: {} (open) to {} rad (closed), {} rad/s", hinge.name,
                                        rounded(hinge.lower), rounded(hinge.upper),
                                        rounded(Hinges::torque / hinge.inertia * world.description().step))});
    }
    if (r.hinges.empty())
        out += row(
            {"gripper", "none: leave `_gripper` and `_proximityGripper` unset, or set `gripper` to false"});
    return out;
}

/// Describes the speed that each row of a motor group stands for, and the turn of each column.
std::string motor_section() {
    constexpr int side = 9;
    std::vector<std::string> rows = {"row"}, speeds = {"forward / transSpeed"}, columns = {"column"},
                             turns = {"left turn / rotSpeed"};
    for (int i = 0; i < side; ++i) {
        std::vector<double> cells(side * side);
        cells[static_cast<std::size_t>(i * side + i)] = 1;
        const MotorCommand command = decode_motor(cells, side, side, 1, 1);
        rows.push_back(std::to_string(i + 1)), speeds.push_back(rounded(command.forward));
        columns.push_back(std::to_string(i + 1)), turns.push_back(rounded(command.turn));
    }
    return fmt::format(
        "## Motor group of {} x {} cells\n\n{}{}\n{}{}\n"
        "A random speed of at most {} m/s and {} rad/s is added in every step of the physics.\n",
        side, side, head(rows), row(speeds), head(columns), row(turns), rounded(speed_noise),
        rounded(speed_noise));
}

std::string range_section(const RobotSensors& sensors) {
    if (sensors.range_sensors().empty()) return {};
    std::vector<std::vector<std::string>> columns = {
        {"sensor", "port", "cells", "height above the floor (m)", "nearest distance d (m)", "range (m)",
         "activity of a cell", "activity at the nearest distance", "noise of d, standard deviation (m)",
         "noise of the activity", "scans per second with `--sensor-rates`"}};
    for (const RangeSensor& s : sensors.range_sensors()) {
        const RangeScanner scanner(s, sensors.link_pose());
        double nearest = s.min_range, activity = 0;
        scanner.to_activity({&nearest, 1}, {&activity, 1});
        columns.push_back({"`" + s.name + "`", s.use() ? fmt::format("`{}`", s.use()->port) : "none",
                           fmt::format("{} x 1", s.rays), rounded(scanner.height()), rounded(s.min_range),
                           rounded(s.max_range),
                           s.max_range == 1 ? "1 - d" : fmt::format("1 - d / {}", rounded(s.max_range)),
                           rounded(activity), rounded(s.noise), rounded(s.noise / s.max_range),
                           s.rate > 0 ? rounded(s.rate) : "one per step"});
    }
    std::string out = "\n## Range sensors\n\n";
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        std::vector<std::string> cells;
        for (const auto& column : columns) cells.push_back(column[i]);
        out += i == 0 ? head(cells) : row(cells);
    }
    return out;
}

/// The angle of every cell: the cells from the left beside those from the right.
std::string angle_section(const RobotSensors& sensors) {
    std::string out;
    std::vector<const RangeSensor*> done;
    for (const RangeSensor& s : sensors.range_sensors()) {
        const auto same = [&](const RangeSensor& other) {
            return other.rays == s.rays && other.first_angle == s.first_angle &&
                   other.last_angle == s.last_angle;
        };
        if (std::ranges::any_of(done, [&](const auto* other) { return same(*other); })) continue;
        done.push_back(&s);
        std::string names;
        for (const RangeSensor& other : sensors.range_sensors())
            if (same(other)) names += fmt::format("{}`{}`", names.empty() ? "" : " and ", other.name);
        out += fmt::format(
            "\n## Angles of the cells of {}\n\nPositive angles are to the left of the robot's heading.\n\n",
            names);
        out += head({"cell", "angle (rad)", "angle (°)", "cell", "angle (rad)", "angle (°)"});
        for (int k = 0; k < (s.rays + 1) / 2; ++k) {
            std::vector<std::string> cells;
            for (const int cell : {k, s.rays - 1 - k}) {
                cells.push_back(fmt::format("({}, 1)", cell + 1));
                cells.push_back(rounded(s.cell_angle(cell)));
                cells.push_back(degrees(s.cell_angle(cell)));
            }
            out += row(cells);
        }
    }
    return out;
}

std::string camera_section(const World& world, const RobotSensors& sensors) {
    if (!sensors.camera_sensor()) return {};
    const CameraSensor& s = *sensors.camera_sensor();
    const Pose pose = sensors.link_pose() * s.pose;
    const Eigen::Vector3d axis = pose.linear().col(0), at = pose.translation();
    const double pitch = std::atan2(-axis.z(), axis.head<2>().norm());
    const double high = 2 * std::atan(std::tan(s.horizontal_fov / 2) * s.height / s.width);
    std::string out = "\n## Camera\n\n" + head({"", ""});
    out += row({"image", fmt::format("{} x {} pixels", s.width, s.height)});
    out += row({"place", fmt::format("{} m ahead of the robot's middle, {} m above the floor",
                                     rounded(at.x()), rounded(at.z()))});
    out += row({"looks down by", fmt::format("{} rad ({}°)", rounded(pitch), degrees(pitch))});
    out +=
        row({"opening angle", fmt::format("{} rad ({}°) wide, {} rad ({}°) high", rounded(s.horizontal_fov),
                                          degrees(s.horizontal_fov), rounded(high), degrees(high))});
    out += row({"sees up to", rounded(s.far) + " m"});
    out += row({"noise of a colour", rounded(s.noise) + " (standard deviation; colours are 0 to 1)"});
    out += row({"images per second with `--sensor-rates`", s.rate > 0 ? rounded(s.rate) : "one per step"});
    const Camera camera(s, sensors.link_pose(), world.scene());
    out += "\nThe floor that a row of pixels sees, from the middle of the robot:\n\n";
    out += head({"row", "distance ahead (m)", "from the left to the right pixel (m)"});
    for (int y = 0; y < s.height; y += y == 0 ? 3 : 4) {
        const auto left = camera.floor_point(0, y), right = camera.floor_point(s.width - 1, y);
        if (left && right)
            out += row({std::to_string(y + 1), rounded((left->x() + right->x()) / 2, 3),
                        fmt::format("{} to {}", rounded(left->y(), 3), rounded(right->y(), 3))});
        else
            out += row({std::to_string(y + 1), "above the horizon", ""});
    }
    return out;
}

}  // namespace

std::string data_sheet(const World& world, std::size_t robot) {
    const RobotSensors& sensors = world.robot(robot).sensors;
    return fmt::format("# {}, a robot of {}\n\n", world.robot(robot).name,
                       std::filesystem::path(world.description().path).filename().string()) +
           body_section(world, robot) + "\n" + motor_section() + range_section(sensors) +
           angle_section(sensors) + camera_section(world, sensors);
}

}  // namespace forage::bug
