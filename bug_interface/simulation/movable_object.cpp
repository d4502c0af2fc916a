#include "bug_interface/simulation/movable_object.h"

#include <algorithm>

#include "bug_interface/simulation/world_queries.h"

namespace forage::bug {
namespace {

constexpr double gravity = 9.8;  ///< m/s^2

/// The pose of an object's frame in its model.
Pose frame_of(const Model& model) {
    return model.links.empty() ? Pose::Identity() : in_space(in_plane(model.links.front().pose));
}

}  // namespace

bool is_movable(const Model& model) {
    return !model.is_static && !robot_link(model) && !solids_of(model).empty();
}

WorldDescription static_part(WorldDescription world) {
    std::erase_if(world.models, [](const Model& m) { return robot_link(m) || is_movable(m); });
    return world;
}

MovableObject movable_object_of(const Model& model) {
    MovableObject object;
    object.name = model.name;
    Model at_origin = model;
    at_origin.pose = frame_of(model).inverse();
    object.start = in_plane(model.pose * frame_of(model));
    object.solids = solids_of(at_origin);
    object.resource = has_plugin(model, "libtarget_plugin.so");
    for_each_link(at_origin, Pose::Identity(), [&](const Link& link, const Pose& pose) {
        for (const Visual& v : link.visuals)
            if (v.shape.kind != ShapeKind::plane)
                object.visuals.push_back({0,
                                          -1,
                                          pose * v.pose,
                                          {{v.shape.kind, Pose::Identity(), v.shape.size}, v.material},
                                          false});
    });
    return object;
}

Body body_of(const Model& model, const MovableObject& object, Heights& heights, Diagnostics& diagnostics) {
    Body body;
    body.driven = false, body.radius = 0, body.mass = 0, body.inertia = 0;
    double friction = 1;
    std::vector<Location> locations;  // of the solids
    for_each_link(model, Pose::Identity(), [&](const Link& link, const Pose&) {
        body.mass += link.mass, body.inertia += link.inertia_z;
        for (const Collision& c : link.collisions) {
            friction = std::min(friction, c.friction);
            if (c.shape.kind != ShapeKind::plane) locations.push_back(c.where);
        }
    });
    double radius = 0;  // radius of the largest shape, m
    for (std::size_t i = 0; i < object.solids.size(); ++i) {
        const Solid& solid = object.solids[i];
        const double centre = solid.pose.translation().z(), half = solid.size.z() / 2;
        const int layer =
            heights.layer(std::max(0.0, centre - half), centre + half, locations[i], diagnostics);
        const auto outline = cross_section(solid, centre);
        if (!outline) continue;
        radius = std::max(radius, bounding_radius(*outline));
        if (object.solids.size() == 1 && outline->round && std::hypot(outline->x, outline->y) < 1e-9) {
            body.radius = outline->radius, body.layer = layer, body.friction = friction;
            continue;
        }
        body.parts.push_back({*outline, layer, friction});
    }
    body.deceleration = friction * gravity;
    body.angular_deceleration = friction * gravity * body.mass * radius / 2 / body.inertia;
    return body;
}

}  // namespace forage::bug
