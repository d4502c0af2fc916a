#include "bug_interface/simulation/robot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/simulation/world_queries.h"

namespace forage::bug {

Robot::Robot(const Model& model, std::size_t robot_number, std::uint64_t seed, bool noise, Heights& heights,
             Diagnostics& diagnostics)
    : name(model.name),
      number(robot_number),
      pose(in_plane(model.pose)),
      motor_noise(robot_stream(seed, name, RobotStream::motor_noise)),
      sensors(*robot_link(model), name, number, seed, noise) {
    const Link& link = *robot_link(model);
    const auto disc = std::ranges::find_if(
        link.collisions, [](const Collision& c) { return c.shape.kind == ShapeKind::cylinder; });
    if (disc == link.collisions.end()) {
        diagnostics.error(link.where,
                          fmt::format("the body of robot '{}' has no cylinder as its collision shape", name),
                          "the body of a robot must be an upright cylinder");
        return;
    }
    const Pose disc_pose = link.pose * disc->pose;
    if (disc_pose.translation().head<2>().norm() > 1e-6 || disc_pose.linear()(2, 2) < 1 - 1e-6)
        diagnostics.error(
            disc->where,
            fmt::format("the body of robot '{}' does not stand upright on its model's origin", name));
    const auto layer_of = [&](const Solid& solid, const Location& where) {
        const double centre = solid.pose.translation().z(), half = solid.size.z() / 2;
        return heights.layer(centre - half, centre + half, where, diagnostics);
    };
    body.radius = disc->shape.size.x() / 2, body.mass = link.mass, body.inertia = link.inertia_z;
    body.friction = disc->friction;
    body.layer = layer_of({ShapeKind::cylinder, disc_pose, disc->shape.size}, disc->where);

    for (const RobotLink& robot_part : links_of(model, hinges)) {
        for (const Collision& c : robot_part.link->collisions) {
            if (c.shape.kind == ShapeKind::plane) continue;
            const Solid solid{c.shape.kind, robot_part.home * c.pose, c.shape.size};
            const bool is_central_disc = &c == &*disc;
            solids.push_back({number, robot_part.hinge, solid, is_central_disc});
            if (is_central_disc) continue;
            const auto outline = cross_section(solid, solid.pose.translation().z());
            const int layer = layer_of(solid, c.where);
            if (!outline) continue;
            parts.push_back({number, robot_part.hinge, *outline});
            body.parts.push_back({*outline, layer, c.friction});
        }
        for (const Visual& v : robot_part.link->visuals)
            if (v.shape.kind != ShapeKind::plane)
                visuals.push_back({number,
                                   robot_part.hinge,
                                   robot_part.home * v.pose,
                                   {{v.shape.kind, Pose::Identity(), v.shape.size}, v.material},
                                   robot_part.link == &link});
    }
}

void Robot::checkpoint(Archive& archive) {
    archive.same(name, "a robot");
    archive(pose, command, hinges, transceiver);
    if (reset) archive(*reset);
    archive(*trials, sensors);
}

double Robot::gripper_travel(double step) const {
    double turn = 0, reach = 0;
    for (std::size_t h = 0; h < hinges.size(); ++h)
        turn += std::abs(hinges.next(h, step, 1) - hinges[h].angle);  // hinges carry each other
    if (turn == 0) return 0;
    for (const MovingOutline& part : parts)
        if (part.hinge >= 0)
            reach =
                std::max(reach, std::hypot(part.outline.x, part.outline.y) + bounding_radius(part.outline));
    return turn * 2 * reach;
}

void Robot::move_gripper(Physics& physics, double step, std::uint64_t steps) {
    for (std::size_t h = 0; h < hinges.size(); ++h) {
        if (blocked_[h] || turn_hinge(physics, h, hinges.next(h, step, steps))) continue;
        // What blocks the way of many substeps may be farther away than one.
        blocked_[h] = steps == 1 || !turn_hinge(physics, h, hinges.next(h, step, 1));
    }
}

/// Turns a hinge with all that it carries. Returns false, and turns nothing, when the way is blocked.
bool Robot::turn_hinge(Physics& physics, std::size_t hinge, double angle) {
    const double before = hinges[hinge].angle;
    if (angle == before) return true;
    hinges.set(hinge, angle);
    turned_.clear();
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (!hinges.turns_with(parts[p].hinge, static_cast<int>(hinge))) continue;
        const Pose2 displacement = hinges.displacement(static_cast<std::size_t>(parts[p].hinge));
        turned_.emplace_back(p, Transform2(displacement) * parts[p].outline);
    }
    if (physics.rotate_parts(number, turned_)) return true;
    hinges.set(hinge, before);
    return false;
}

}  // namespace forage::bug
