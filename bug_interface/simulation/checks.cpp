#include "bug_interface/simulation/checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "bug_interface/simulation/surroundings.h"

namespace forage::bug {
namespace {

constexpr double farthest = 1000;  ///< m; contacts are found in single precision

bool upright(const Pose& pose) { return std::abs(pose.linear()(2, 2)) > 1 - 1e-6; }

const std::array<std::string, 3> known_plugins = {"libvel_plugin.so", "libreset_plugin.so",
                                                  "libtarget_plugin.so"};

void check_plugins(const Model& model, Diagnostics& diagnostics) {
    const bool robot = robot_link(model);
    for (const Plugin& p : model.plugins) {
        if (std::find(known_plugins.begin(), known_plugins.end(), p.filename) == known_plugins.end()) {
            const auto near = nearest(p.filename, known_plugins);
            diagnostics.warning(
                p.where, fmt::format("plugin '{}' is not known here and does nothing", p.filename),
                near.empty() ? "known are libvel_plugin.so, libreset_plugin.so and libtarget_plugin.so"
                             : fmt::format("did you mean {}?", near));
        } else if (p.filename == "libvel_plugin.so" && !robot) {
            diagnostics.error(p.where, fmt::format("'{}' has no link 'bug' that could be driven", model.name),
                              "name the link of the robot's body 'bug'");
        } else if (p.filename == "libreset_plugin.so" && !robot) {
            diagnostics.warning(p.where, fmt::format("'{}' is no robot, and is never put back", model.name),
                                "libreset_plugin.so has an effect in robots only");
        } else if (p.filename == "libtarget_plugin.so" && (robot || model.is_static)) {
            diagnostics.warning(
                p.where,
                fmt::format("'{}' {}, and counts at no home", model.name, robot ? "is a robot" : "is static"),
                "a resource is a model that can be pushed");
        }
    }
    const bool body =
        std::any_of(model.links.begin(), model.links.end(), [](const Link& l) { return l.name == "bug"; });
    if (body && !robot)
        diagnostics.warning(model.where,
                            fmt::format("'{}' has a link 'bug', but no plugin that drives it", model.name),
                            "<plugin name=\"velocity\" filename=\"libvel_plugin.so\"/> makes it a robot");
}

/// A robot's sensors are those of its body.
void check_sensors(const Model& robot, Diagnostics& diagnostics) {
    const Link* body = robot_link(robot);
    each_link(robot, Pose::Identity(), [&](const Link& link, const Pose&) {
        if (&link == body) return;
        const auto warn = [&](const Location& where, const std::string& sensor) {
            diagnostics.warning(where,
                                fmt::format("sensor '{}' of '{}' has no effect in the link '{}'", sensor,
                                            robot.name, link.name),
                                "the sensors of a robot stand in its link 'bug'");
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
        diagnostics.error(model.where, fmt::format("robot '{}' is static, and could not move", model.name),
                          "take <static> away");
    if (!upright(model.pose) || std::abs(model.pose.translation().z()) > 0.01)
        diagnostics.warning(
            model.where,
            fmt::format("robot '{}' drives on the floor: the rest of its pose has no effect", model.name),
            "give x y 0 0 0 yaw");
}

void check_shapes(const Model& model, Diagnostics& diagnostics) {
    each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
        for (const Collision& c : link.collisions)
            if (c.shape.kind != ShapeKind::plane && c.shape.kind != ShapeKind::sphere &&
                !upright(pose * c.pose))
                diagnostics.warning(c.where,
                                    fmt::format("a tilted shape of '{}' counts as upright here", model.name),
                                    "only cameras see how it is tilted; build slopes of upright boxes");
    });
}

void check_homes(const WorldDescription& world, Diagnostics& diagnostics) {
    const auto find = [&](const char* name) {
        const auto found = std::find_if(world.models.begin(), world.models.end(),
                                        [&](const Model& m) { return m.name == name; });
        return found == world.models.end() ? nullptr : &*found;
    };
    const Model *a = find("Home_A"), *b = find("Home_B");
    if (!a && !b && world.game)
        diagnostics.warning(world.game->where, "no models are named Home_A and Home_B",
                            "the homes are taken to be at (-10, 10) and (10, -10)");
    if ((a == nullptr) == (b == nullptr)) return;
    diagnostics.warning((a ? a : b)->where,
                        fmt::format("there is '{}' but no '{}'", (a ? a : b)->name, a ? "Home_B" : "Home_A"),
                        a ? "the home of team B is taken to be at (10, -10)"
                          : "the home of team A is taken to be at (-10, 10)");
}

/// Who is put back when it leaves the bounds.
void check_starts(const WorldDescription& world, Diagnostics& diagnostics) {
    const auto start = std::find_if(world.models.begin(), world.models.end(),
                                    [](const Model& m) { return m.name == "Reset_0"; });
    const auto robots = [&](bool with_reset) {
        return std::any_of(world.models.begin(), world.models.end(), [&](const Model& m) {
            return robot_link(m) && (!with_reset || has_plugin(m, "libreset_plugin.so"));
        });
    };
    if (start != world.models.end() && robots(false) && !robots(true))
        diagnostics.warning(
            start->where, "there are start poses, but no robot is ever put back to them",
            "<plugin name=\"reset\" filename=\"libreset_plugin.so\"/> in the robot's model does that");
}

}  // namespace

void check_models(const WorldDescription& world, Diagnostics& diagnostics) {
    constexpr std::ptrdiff_t most_robots = 200;  // each keeps its own pictures of what it sees: about 1 MB
    std::ptrdiff_t robots = 0;
    for (const Model& model : world.models)
        if (robot_link(model) && ++robots == most_robots + 1)
            diagnostics.error(model.where,
                              fmt::format("this is robot {}: a world holds {} at most", robots, most_robots),
                              "take some away, or run several worlds");
    for (const Model& model : world.models) {
        check_plugins(model, diagnostics);
        if (robot_link(model)) check_robot(model, diagnostics), check_sensors(model, diagnostics);
        check_shapes(model, diagnostics);
        if (!(model.pose.translation().cwiseAbs().maxCoeff() <= farthest))
            diagnostics.error(model.where, fmt::format("'{}' is more than {} m away", model.name, farthest),
                              "poses are in m");
    }
    check_homes(world, diagnostics);
    check_starts(world, diagnostics);
}

}  // namespace forage::bug
