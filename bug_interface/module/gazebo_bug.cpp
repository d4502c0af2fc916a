#include "bug_interface/module/gazebo_bug.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bug_interface/motion/motor.h"
#include "core/base/diagnostic.h"

namespace forage::bug {
namespace {

enum In : std::size_t { motor, gripper_command, audio_out };
enum Out : std::size_t {
    proximity,
    target,
    gripper_scan,
    gps,
    image_first,
    image_second,
    image_third,
    place_group,
    head_group,
    audio_in,
    trial
};

constexpr int max_image_width = 32, max_image_height = 28;

std::span<double> cells_of(Column& column) {
    return {column.data(), static_cast<std::size_t>(column.size())};
}

bool is_square(const GroupShape& s) { return s == rectangle(s.width, s.width); }

std::string no_robot(const World& world, const std::string& name) {
    return fmt::format("there is no robot '{}' in the world '{}'", name, world.description().path);
}

std::string robots_of(const World& world, const std::string& name) {
    const auto names = world.robot_names();
    return names.empty() ? "the world has no robot: a robot is a model with a link 'bug' and the plugin "
                           "libvel_plugin.so"
                         : suggest(name, names);
}

/// The speeds that the rows and columns of a motor group stand for, as shares of the largest ones.
CellNames motor_names(const GroupShape& shape) {
    CellNames out;
    const auto named = [](int i, int n, const char* before, const char* middle, const char* after) {
        const int share = static_cast<int>(std::lround(100.0 * (n / 2 - i) / std::max(1, n / 2)));
        return share == 0 ? middle : fmt::format("{} {} %", share > 0 ? before : after, std::abs(share));
    };
    for (int y = 0; y < shape.height; ++y)
        out.rows.push_back(named(y, shape.height, "ahead", "on the spot", "back"));
    for (int x = 0; x < shape.width; ++x)
        out.columns.push_back(named(x, shape.width, "left", "straight", "right"));
    return out;
}

/// An angle to the left of where the robot looks.
std::string side_name(double angle) {
    const int degrees = static_cast<int>(std::lround(angle * 180 / std::numbers::pi));
    return degrees == 0 ? "ahead" : fmt::format("{} {}°", degrees > 0 ? "left" : "right", std::abs(degrees));
}

/// Where the rays of a sensor look, which the robot of the world says.
auto rays_of(RangePurpose purpose) {
    return [purpose](const GazeboBug& module, const ModulePorts& ports, const GroupShape& shape) {
        CellNames out;
        const auto* world = dynamic_cast<const World*>(ports.environment);
        const auto bug = world ? world->find(module.device_name) : std::nullopt;
        if (!bug) return out;
        for (const auto& s : world->robot(*bug).sensors.range_sensors())
            if (s.purpose() == purpose && s.rays == shape.cells)
                for (int k = 0; k < s.rays; ++k) out.columns.push_back(side_name(s.cell_angle(k)));
        return out;
    };
}

/// The headings of head direction cells, while they are the points of a compass.
CellNames heading_names(const GroupShape& shape) {
    constexpr const char* compass[] = {"west", "south-west", "south", "south-east",
                                       "east", "north-east", "north", "north-west"};
    constexpr int points = std::size(compass);
    const int n = shape.cells;
    std::vector<std::string> out;
    for (int k = 0; k < n; ++k)
        out.push_back(points * k % n == 0
                          ? compass[points * k / n]
                          : fmt::format("heading {:.3g}°", std::fmod(540 + 360.0 * k / n, 360)));
    if (shape.width == n) return {.columns = out};
    if (shape.height == n) return {.rows = out};
    return {};
}

}  // namespace

void GazeboBug::describe(ModuleSpec<GazeboBug>& s) {
    using T = GazeboBug;
    s.name("moduleGazeboBug", "Gazebo Bug")
        .doc("Connects the system to a robot of a simulated world: motors, sensors and communication.");
    s.param("device_name", &T::device_name)
        .label("Device name")
        .at_start()
        .doc("Name of the robot's model in the world file.");
    s.param("cps", &T::cps)
        .label("Cycles per second")
        .unit("1/s")
        .doc("Has no effect: the robot moves in lock-step with the system.");
    s.param("comkey", &T::comkey)
        .label("Communication key")
        .doc("Robots with the same key receive each other's messages.");
    s.param("gripper", &T::gripper)
        .label("Has gripper")
        .at_start()
        .doc(
            "Whether the robot has a gripper. Only then are the sizes of the gripper's groups and the robot "
            "checked.");
    s.param("grayscale", &T::grayscale)
        .label("Grayscale")
        .doc("Whether the three image groups all receive the grey value. Takes precedence over hsv.");
    s.param("hsv", &T::hsv)
        .label("HSV")
        .doc("Whether the image groups receive hue, saturation and value instead of red, green and blue.");
    s.param("transSpeed", &T::trans_speed)
        .label("Translation speed")
        .unit("m/s")
        .doc(
            "Forward speed that the top row of the motor group stands for. The bottom row stands for the "
            "same speed backwards, and the rows between for proportional speeds.");
    s.param("rotSpeed", &T::rot_speed)
        .label("Rotation speed")
        .unit("rad/s")
        .doc(
            "Angular velocity of the left turn that the left column of the motor group stands for. The right "
            "column stands for the same turn to the right, and the columns between for proportional turns.");
    s.param("placeXOffset", &T::place_x_offset)
        .label("Place X offset")
        .unit("m")
        .doc("x of the centre of the area that the place cells cover. Has no effect on the GPS.");
    s.param("placeYOffset", &T::place_y_offset)
        .label("Place Y offset")
        .unit("m")
        .doc("y of the centre of the area that the place cells cover. Has no effect on the GPS.");
    s.param("placeXMax", &T::place_x_max)
        .label("Place X max")
        .unit("m")
        .doc(
            "Half the extent in x of the area that the place cells cover. It is also added to x in the GPS "
            "group, so that x is not negative there.");
    s.param("placeYMax", &T::place_y_max)
        .label("Place Y max")
        .unit("m")
        .doc(
            "Half the extent in y of the area that the place cells cover. It is also added to y in the GPS "
            "group, so that y is not negative there.");
    s.param("placeSigma", &T::place_sigma)
        .label("Place sigma")
        .unit("half extents")
        .doc(
            "Width of a place cell's receptive field, exp(-(distance/sigma)^2), in units of half the extent "
            "of the area: 0.2 with placeXMax 10 is 2 m.");
    s.param("headSigma", &T::head_sigma)
        .label("Head sigma")
        .unit("turn")
        .doc(
            "Width of a head direction cell's receptive field, exp(-(distance/sigma)^2), in turns: 0.1 is 36 "
            "degrees.");

    s.input("_motor", "Motor")
        .size("a square with an odd number of rows, at least 3, such as 9 x 9",
              [](const auto&, PortSizes&, const GroupShape& given) {
                  return is_square(given) && given.width % 2 == 1 && given.width > 1 ? given
                                                                                     : rectangle(9, 9);
              })
        .tolerate([](PortSizes&, const GroupShape& given) { return is_square(given) && given.width > 1; })
        .doc(
            "The most active cell is the velocity, whatever its activity. The top row drives forwards at "
            "transSpeed, the bottom row backwards, the middle row not at all. The left column turns left at "
            "rotSpeed, the right column right, the middle column drives straight on. No active cell, or all "
            "cells equal: the robot stops.")
        .names([](const auto&, const ModulePorts&, const GroupShape& shape) { return motor_names(shape); });
    s.input("_gripper", "Gripper")
        .optional()
        .size("1 cell if 'gripper' is true",
              [](const GazeboBug& module, PortSizes&, const GroupShape& given) {
                  return !module.gripper || given.cells == 1 ? given : rectangle(1, 1);
              })
        .doc("Above 0.5 the gripper closes, otherwise it opens.");
    s.input("_audio_out", "Shout")
        .optional()
        .cells(36)
        .doc("The message to the robots with the same comkey.");
    s.output("_proximity", "Proximity sensor")
        .optional()
        .size(32, 1)
        .doc(
            "One cell per ray of the sensor 'laser', from left to right: 1 - distance / range, or 0 if "
            "nothing is in range.")
        .names(rays_of(RangePurpose::proximity));
    s.output("_target", "Target sensor")
        .optional()
        .size(32, 1)
        .doc(
            "One cell per ray of the sensor 'laser_target', which sees the light, from left to right: 1 - "
            "distance / range, or 0 if no light is in range.")
        .names(rays_of(RangePurpose::light));
    s.output("_proximityGripper", "Gripper proximity sensor")
        .optional()
        .size("16 x 1 cells if 'gripper' is true",
              [](const GazeboBug& module, PortSizes&, const GroupShape& given) {
                  return module.gripper ? rectangle(16, 1) : given;
              })
        .doc(
            "One cell per ray of the sensor 'laser_gripper' between the fingers, from left to right: 1 - "
            "distance / range. The outer cells see the palm.")
        .names(rays_of(RangePurpose::gripper));
    s.output("_gps", "GPS")
        .optional()
        .size(3, 1)
        .names([](const GazeboBug& module, const ModulePorts&, const GroupShape&) {
            return CellNames{.columns = {fmt::format("x + {} m", module.place_x_max),
                                         fmt::format("y + {} m", module.place_y_max), "heading + pi"}};
        })
        .doc(
            "The place, x + placeXMax and y + placeYMax in m, and heading + pi in rad (0 to 2 pi; east is "
            "pi).");
    const auto image = [&](const char* port, const char* label, const char* doc,
                           std::vector<const char*> before) {
        s.output(port, label)
            .optional()
            .size(fmt::format("a full rectangle of at most {} x {} cells, the same for all image groups",
                              max_image_width, max_image_height),
                  [before = std::move(before)](const auto&, PortSizes& of, const GroupShape& given) {
                      for (const char* other : before)
                          if (of.has(other) && !(of[other] == given)) return of[other];
                      return rectangle(std::min(given.width, max_image_width),
                                       std::min(given.height, max_image_height));
                  })
            .doc(doc);
    };
    image("_image_RH", "Image red or hue",
          "Red, hue if hsv is true, or grey if grayscale is true, 0 to 1. The top row is far away.", {});
    image("_image_GS", "Image green or saturation", "Green, saturation or grey.", {"_image_RH"});
    image("_image_BV", "Image blue or value", "Blue, value or grey.", {"_image_RH", "_image_GS"});
    s.output("placeCell", "Place cells")
        .optional()
        .full_rectangle()
        .doc(
            "The position: 1 at the cell whose field is nearest. Columns from -placeXMax to placeXMax, rows "
            "from placeYMax (top) to -placeYMax.");
    s.output("headCell", "Head direction cells")
        .optional()
        .names([](const auto&, const ModulePorts&, const GroupShape& shape) { return heading_names(shape); })
        .doc("The heading: cell 1 of n is west, n/4 + 1 south, n/2 + 1 east, 3n/4 + 1 north.");
    s.output("_audio_in", "Listen")
        .optional()
        .cells(36)
        .doc("The sum of the messages of the other robots, each attenuated with its distance.");
    s.output("_trial", "Trial")
        .optional()
        .size(2, 1)
        .names({"target reached", "between trials"})
        .doc(
            "Cell 1: 1 in the cycle after a trial that reached a target. Cell 2: 1 from the end of a trial "
            "to the beginning of the next one. Not delayed by --latency.");
}

void GazeboBug::check(const ModulePorts& ports, Diagnostics& diagnostics) {
    const auto report = [&](const ModulePorts::Group& group, std::string message, std::string hint) {
        diagnostics.error(at_port(group.port), std::move(message), std::move(hint));
    };
    if (!(place_x_max > 0 && place_y_max > 0 && place_sigma > 0 && head_sigma > 0))
        diagnostics.error(at_parameter(!(place_x_max > 0)   ? "placeXMax"
                                       : !(place_y_max > 0) ? "placeYMax"
                                       : !(place_sigma > 0) ? "placeSigma"
                                                            : "headSigma"),
                          "placeXMax, placeYMax, placeSigma and headSigma must be above 0");
    constexpr double fastest = 1000;  // a step must not lead further than numbers of the world reach
    for (const auto& [name, speed] : {std::pair{"transSpeed", trans_speed}, {"rotSpeed", rot_speed}})
        if (!(std::abs(speed) <= fastest))
            diagnostics.error(at_parameter(name), fmt::format("{} is more than {}", name, fastest),
                              "in m/s and rad/s; a robot drives at about 1");

    world_ = dynamic_cast<World*>(ports.environment);
    if (!world_) return;
    const auto bug = world_->find(device_name);
    if (!bug) {
        diagnostics.error(at_parameter("device_name"), no_robot(*world_, device_name),
                          robots_of(*world_, device_name));
        return;
    }
    const auto scanner = [&](std::size_t port, std::size_t rays, RangePurpose purpose) {
        const auto sensor = range_uses[static_cast<std::size_t>(purpose)].sensor;
        const auto& g = ports.outputs[port];
        if (g.shape.cells > 0 && static_cast<std::size_t>(g.shape.cells) != rays)
            report(g,
                   rays == 0 ? fmt::format("robot '{}' has no ray sensor '{}'", device_name, sensor)
                             : fmt::format("the ray sensor '{}' of robot '{}' has {} rays, not {}", sensor,
                                           device_name, rays, g.shape.cells),
                   {});
    };
    scanner(proximity, world_->snapshot(*bug).proximity.size(), RangePurpose::proximity);
    scanner(target, world_->snapshot(*bug).target.size(), RangePurpose::light);
    const bool connected =
        ports.inputs[gripper_command].shape.cells == 1 || ports.outputs[gripper_scan].shape.cells == 16;
    if (gripper && connected && !world_->has_gripper(*bug))  // the original waits forever
        diagnostics.error(at_parameter("gripper"), fmt::format("robot '{}' has no gripper", device_name),
                          "set 'gripper' to false, or use a robot with a gripper");
    if (gripper && world_->has_gripper(*bug))
        scanner(gripper_scan, world_->snapshot(*bug).gripper.size(), RangePurpose::gripper);
}

void GazeboBug::start(const ModulePorts& ports, ModuleFrame& frame) {
    world_ = dynamic_cast<World*>(ports.environment);
    if (!world_) throw std::runtime_error("this system drives a robot and needs a world: add --world FILE");
    const auto bug = world_->find(device_name);
    if (!bug)
        throw std::runtime_error(no_robot(*world_, device_name) + "; " + robots_of(*world_, device_name));
    bug_ = *bug;
    claim_.reset();
    claim_ = world_->claim(bug_);
    if (!claim_)
        throw std::runtime_error(
            fmt::format("two modules drive the robot '{}'; each needs its own robot", device_name));

    motor_ = ports.inputs[motor].shape;
    place_ = ports.outputs[place_group].shape;
    image_ = {};
    for (const std::size_t port : {image_first, image_second, image_third})
        if (frame.is_read(port)) image_ = ports.outputs[port].shape;
    const BugSnapshot& seen = world_->snapshot(bug_);
    if (seen.image_width == 0) image_ = {};
    if (image_.cells > 0)
        image_cells_.emplace(seen.image_width, seen.image_height, image_.width, image_.height);
    unused_.assign(static_cast<std::size_t>(image_.cells), 0);
    world_->request_image(bug_, image_.cells > 0);
    world_->request_gripper_scan(bug_, gripper && frame.is_read(gripper_scan));
}

void GazeboBug::update(ModuleFrame& frame) {
    const auto& activity = frame.input(motor);
    world_->command(bug_, decode_motor({activity.data(), static_cast<std::size_t>(activity.size())},
                                       motor_.width, motor_.height, trans_speed, rot_speed));
    if (gripper && frame.input(gripper_command).size() == 1)
        world_->grip(bug_, frame.input(gripper_command)[0] > 0.5);
    const auto& message = frame.input(audio_out);
    world_->transmit(bug_, comkey, {message.data(), static_cast<std::size_t>(message.size())});
    copy_scans(frame);
    copy_pose(frame);
    if (image_.cells > 0) copy_image(frame);
}

void GazeboBug::copy_scans(ModuleFrame& frame) const {
    const BugSnapshot& seen = world_->snapshot(bug_);
    const auto copy = [](const std::vector<double>& from, Column to) {
        std::copy_n(from.begin(), std::min(from.size(), static_cast<std::size_t>(to.size())), to.data());
    };
    if (frame.is_read(proximity)) copy(seen.proximity, frame.output(proximity));
    if (frame.is_read(target)) copy(seen.target, frame.output(target));
    if (gripper && frame.is_read(gripper_scan)) copy(seen.gripper, frame.output(gripper_scan));
    if (frame.is_read(audio_in))
        std::copy(seen.received.begin(), seen.received.end(), frame.output(audio_in).data());
}

void GazeboBug::copy_pose(ModuleFrame& frame) const {
    const Pose2& at = world_->snapshot(bug_).pose;
    if (frame.is_read(gps) && frame.output_size(gps) == 3) {
        Column out = frame.output(gps);
        out[0] = at.x + place_x_max;
        out[1] = at.y + place_y_max;
        out[2] = at.yaw + std::numbers::pi;
    }
    if (frame.is_read(place_group)) {
        Column out = frame.output(place_group);
        place_cells(at.x, at.y, place_.width, place_.height,
                    {place_x_offset, place_y_offset, place_x_max, place_y_max, place_sigma}, cells_of(out));
    }
    if (frame.is_read(trial)) {
        Column out = frame.output(trial);
        out[0] = world_->just_reached(bug_);
        out[1] = world_->resetting(bug_);
    }
    if (frame.is_read(head_group)) {
        Column out = frame.output(head_group);
        head_direction_cells(at.yaw, head_sigma, cells_of(out));
    }
}

void GazeboBug::copy_image(ModuleFrame& frame) {
    const BugSnapshot& seen = world_->snapshot(bug_);
    const auto channel = [&](std::size_t port) {
        if (!frame.is_read(port)) return std::span<double>(unused_);
        Column out = frame.output(port);
        return cells_of(out);
    };
    const ColourSpace space = grayscale ? ColourSpace::grey : hsv ? ColourSpace::hsv : ColourSpace::rgb;
    image_cells_->fill(seen.image, space, channel(image_first), channel(image_second), channel(image_third));
}

ModuleType gazebo_bug_type() { return module_type<GazeboBug>(); }

}  // namespace forage::bug
