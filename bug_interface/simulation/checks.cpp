#include "bug_interface/simulation/checks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/simulation/surroundings.h"

namespace forage::bug {
namespace {

constexpr double farthest = 1000;  ///< m; contacts are found in single precision

bool upright(const Pose& pose) { return std::abs(pose.linear()(2, 2)) > 1 - 1e-6; }

void check_plugins(const Model& model, Diagnostics& diagnostics) {
    for (const Plugin& p : model.plugins)
        if (p.filename != "libvel_plugin.so" && p.filename != "libreset_plugin.so" &&
            p.filename != "libtarget_plugin.so")
            diagnostics.warning(p.where,
                                fmt::format("plugin '{}' is not known here and does nothing", p.filename),
                                "known are libvel_plugin.so, libreset_plugin.so and libtarget_plugin.so");
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
    if ((a == nullptr) == (b == nullptr)) return;
    diagnostics.warning((a ? a : b)->where,
                        fmt::format("there is '{}' but no '{}'", (a ? a : b)->name, a ? "Home_B" : "Home_A"),
                        a ? "the home of team B is taken to be at (10, -10)"
                          : "the home of team A is taken to be at (-10, 10)");
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
        if (robot_link(model)) check_robot(model, diagnostics);
        check_shapes(model, diagnostics);
        if (!(model.pose.translation().cwiseAbs().maxCoeff() <= farthest))
            diagnostics.error(model.where, fmt::format("'{}' is more than {} m away", model.name, farthest),
                              "poses are in m");
    }
    check_homes(world, diagnostics);
}

}  // namespace forage::bug
