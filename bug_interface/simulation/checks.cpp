#include "bug_interface/simulation/checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "bug_interface/simulation/world_queries.h"

namespace forage::bug {
namespace {

constexpr double max_distance = 1000;  ///< m; contacts are computed in single precision

bool upright(const Pose& pose) { return std::abs(pose.linear()(2, 2)) > 1 - 1e-6; }

const std::array<std::string, 3> known_plugins = {"libvel_plugin.so", "libreset_plugin.so",
                                                  "libtarget_plugin.so"};

void check_plugins(const Model& model, Diagnostics& diagnostics) {
    const bool robot = robot_link(model);
    for (const Plugin& p : model.plugins) {
        if (std::ranges::find(known_plugins, p.filename) == known_plugins.end()) {
            const auto near = nearest(p.filename, known_plugins);
            diagnostics.warning(
                p.where, fmt::format("plugin '{}' is not known and has no effect", p.filename),
                near.empty()
                    ? "the known plugins are libvel_plugin.so, libreset_plugin.so and libtarget_plugin.so"
                    : fmt::format("did you mean {}?", near));
        } else if (p.filename == "libvel_plugin.so" && !robot) {
            diagnostics.error(p.where, fmt::format("'{}' has no link 'bug' that could be driven", model.name),
                              "name the link of the robot's body 'bug'");
        } else if (p.filename == "libreset_plugin.so" && !robot) {
            diagnostics.warning(p.where, fmt::format("'{}' is not a robot and is never reset", model.name),
                                "libreset_plugin.so has an effect only in robots");
        } else if (p.filename == "libtarget_plugin.so" && (robot || model.is_static)) {
            diagnostics.warning(p.where,
                                fmt::format("'{}' {} and does not count at a home", model.name,
                                            robot ? "is a robot" : "is static"),
                                "a resource is a model that can be pushed");
        }
    }
    const bool body = std::ranges::any_of(model.links, [](const Link& l) { return l.name == "bug"; });
    if (body && !robot)
        diagnostics.warning(model.where,
                            fmt::format("'{}' has a link 'bug', but no plugin that drives it", model.name),
                            "<plugin name=\"velocity\" filename=\"libvel_plugin.so\"/> makes it a robot");
}

/// Warns about sensors in other links than the body, and about ray sensors of the same name.
void check_sensors(const Model& robot, Diagnostics& diagnostics) {
    const Link* body = robot_link(robot);
    for_each_link(robot, Pose::Identity(), [&](const Link& link, const Pose&) {
        if (&link == body) return;
        const auto warn = [&](const Location& where, const std::string& sensor) {
            diagnostics.warning(where,
                                fmt::format("sensor '{}' of '{}' has no effect in the link '{}'", sensor,
                                            robot.name, link.name),
                                "the sensors of a robot belong in its link 'bug'");
        };
        for (const RangeSensor& s : link.range_sensors) warn(s.where, s.name);
        for (const CameraSensor& s : link.cameras) warn(s.where, s.name);
    });
    for (std::size_t i = 0; i < body->range_sensors.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (body->range_sensors[i].name == body->range_sensors[j].name)
                diagnostics.warning(body->range_sensors[i].where,
                                    fmt::format("there are two ray sensors '{}'; the first one is used",
                                                body->range_sensors[i].name),
                                    "give each a name of its own: laser, laser_target, laser_gripper");
}

void check_robot(const Model& model, Diagnostics& diagnostics) {
    if (model.is_static)
        diagnostics.error(model.where, fmt::format("robot '{}' is static and cannot move", model.name),
                          "remove <static>");
    if (!upright(model.pose) || std::abs(model.pose.translation().z()) > 0.01)
        diagnostics.warning(
            model.where,
            fmt::format("robot '{}' drives on the floor: only x, y and yaw of its pose have an effect",
                        model.name),
            "write x y 0 0 0 yaw");
}

void check_shapes(const Model& model, Diagnostics& diagnostics) {
    for_each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
        for (const Collision& c : link.collisions)
            if (c.shape.kind != ShapeKind::plane && c.shape.kind != ShapeKind::sphere &&
                !upright(pose * c.pose))
                diagnostics.warning(c.where,
                                    fmt::format("a tilted shape of '{}' is treated as upright", model.name),
                                    "only cameras see the tilt; build slopes from upright boxes");
    });
}

void check_homes(const WorldDescription& world, Diagnostics& diagnostics) {
    const Model *a = find_model(world, "Home_A"), *b = find_model(world, "Home_B");
    if (!a && !b && world.game)
        diagnostics.warning(world.game->where, "no models are named Home_A and Home_B",
                            "the homes are assumed to be at (-10, 10) and (10, -10)");
    if ((a == nullptr) == (b == nullptr)) return;
    diagnostics.warning((a ? a : b)->where,
                        fmt::format("there is '{}' but no '{}'", (a ? a : b)->name, a ? "Home_B" : "Home_A"),
                        a ? "the home of team B is assumed to be at (10, -10)"
                          : "the home of team A is assumed to be at (-10, 10)");
}

/// Warns about start poses that no robot uses.
void check_starts(const WorldDescription& world, Diagnostics& diagnostics) {
    const Model* start = find_model(world, "Reset_0");
    const auto robots = [&](bool with_reset) {
        return std::ranges::any_of(world.models, [&](const Model& m) {
            return robot_link(m) && (!with_reset || has_plugin(m, "libreset_plugin.so"));
        });
    };
    if (start && robots(false) && !robots(true))
        diagnostics.warning(
            start->where, "there are start poses, but no robot is ever reset",
            "add <plugin name=\"reset\" filename=\"libreset_plugin.so\"/> to the model of the robot");
}

}  // namespace

void check_models(const WorldDescription& world, Diagnostics& diagnostics) {
    constexpr std::ptrdiff_t max_robots = 200;  // each takes about 1 MB for the pictures of its camera
    std::ptrdiff_t robots = 0;
    for (const Model& model : world.models)
        if (robot_link(model) && ++robots == max_robots + 1)
            diagnostics.error(model.where,
                              fmt::format("this is robot {}: a world has at most {}", robots, max_robots),
                              "remove some, or run several worlds");
    for (const Model& model : world.models) {
        check_plugins(model, diagnostics);
        if (robot_link(model)) check_robot(model, diagnostics), check_sensors(model, diagnostics);
        check_shapes(model, diagnostics);
        if (!(model.pose.translation().cwiseAbs().maxCoeff() <= max_distance))
            diagnostics.error(model.where,
                              fmt::format("'{}' is more than {} m from the origin", model.name, max_distance),
                              "poses are in m");
    }
    check_homes(world, diagnostics);
    check_starts(world, diagnostics);
}

}  // namespace forage::bug
