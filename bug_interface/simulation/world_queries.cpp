#include "bug_interface/simulation/world_queries.h"

#include <algorithm>

#include "bug_interface/simulation/movable_object.h"
#include "core/base/sequence.h"

namespace forage::bug {
namespace {

constexpr double light_height = 0.35, proximity_height = 0.175;  ///< m

/// Calls visit(collision, solid in world coordinates) for each collision shape of a model that is not a
/// plane.
template <class F>
void for_each_solid(const Model& model, F&& visit) {
    for_each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
        for (const Collision& c : link.collisions)
            if (c.shape.kind != ShapeKind::plane) visit(c, Solid{c.shape.kind, pose * c.pose, c.shape.size});
    });
}

template <class F>
void for_each_static_solid(const WorldDescription& world, F&& visit) {
    for (const Model& model : world.models)
        if (model.is_static) for_each_solid(model, visit);
}

}  // namespace

bool has_plugin(const Model& model, std::string_view filename) {
    return std::ranges::any_of(model.plugins, [&](const Plugin& p) { return p.filename == filename; });
}

const Link* robot_link(const Model& model) {
    return has_plugin(model, "libvel_plugin.so") ? find_by(model.links, "bug", &Link::name) : nullptr;
}

std::vector<Solid> solids_of(const Model& model) {
    std::vector<Solid> out;
    for_each_solid(model, [&](const Collision&, const Solid& solid) { out.push_back(solid); });
    return out;
}

std::optional<double> common_height(const Solid& solid, double low, double high) {
    const double centre = solid.pose.translation().z(), half = solid.size.z() / 2;
    const double from = std::max(low, centre - half), to = std::min(high, centre + half);
    if (to - from < 0.001) return {};
    return solid.kind == ShapeKind::sphere ? std::clamp(centre, from, to) : (from + to) / 2;
}

std::vector<Obstacle> obstacles_of(const WorldDescription& world, const Heights& heights) {
    std::vector<Obstacle> out;
    for_each_static_solid(world, [&](const Collision& collision, const Solid& solid) {
        const std::size_t first = out.size();  // the first obstacle of this solid
        for (std::size_t layer = 0; layer < heights.ranges().size(); ++layer) {
            const auto& [low, high] = heights.ranges()[layer];
            const auto height = common_height(solid, low, high);
            if (!height) continue;
            const auto outline = cross_section(solid, *height);
            if (!outline) continue;
            // An upright solid has the same outline at all heights; a sphere does not.
            const auto same =
                std::find_if(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                             [&](const Obstacle& o) { return o.outline.radius == outline->radius; });
            if (same == out.end())
                out.push_back({*outline, collision.friction, LayerMask{1} << layer});
            else
                same->layers |= LayerMask{1} << layer;
        }
    });
    return out;
}

std::vector<Eigen::Vector2d> targets_of(const WorldDescription& world) {
    std::vector<Eigen::Vector2d> out;
    for_each_static_solid(world, [&](const Collision&, const Solid& solid) {
        if (solid.kind == ShapeKind::cylinder && cross_section(solid, light_height) &&
            !cross_section(solid, proximity_height))
            out.emplace_back(solid.pose.translation().head<2>());
    });
    return out;
}

std::vector<DrawnSolid> drawing_of(const WorldDescription& world) {
    std::vector<DrawnSolid> out;
    for (const Model& model : world.models)
        if (!robot_link(model) && !is_movable(model))
            for_each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
                for (const Visual& v : link.visuals)
                    if (v.shape.kind != ShapeKind::plane)
                        out.push_back({{v.shape.kind, pose * v.pose, v.shape.size}, v.material.diffuse});
                if (!link.visuals.empty()) return;
                for (const Collision& c : link.collisions) {  // so that no wall is invisible
                    const Pose at = pose * c.pose;
                    const bool below = at.translation().z() + c.shape.size.z() / 2 <= 0;  // the floor: bounds
                    if (c.shape.kind != ShapeKind::plane && !below)
                        out.push_back({{c.shape.kind, at, c.shape.size}, Material{}.diffuse});
                }
            });
    return out;
}

}  // namespace forage::bug
