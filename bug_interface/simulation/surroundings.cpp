#include "bug_interface/simulation/surroundings.h"

#include <algorithm>

#include "bug_interface/simulation/movable_object.h"

namespace forage::bug {
namespace {

constexpr double light_height = 0.35, proximity_height = 0.175;  ///< m

template <class F>
void each_static_collision(const WorldDescription& world, F&& visit) {
    for (const Model& model : world.models)
        if (model.is_static)
            each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
                for (const Collision& c : link.collisions)
                    if (c.shape.kind != ShapeKind::plane)
                        visit(c, Solid{c.shape.kind, pose * c.pose, c.shape.size});
            });
}

}  // namespace

bool has_plugin(const Model& model, std::string_view filename) {
    return std::any_of(model.plugins.begin(), model.plugins.end(),
                       [&](const Plugin& p) { return p.filename == filename; });
}

const Link* robot_link(const Model& model) {
    if (!has_plugin(model, "libvel_plugin.so")) return nullptr;
    const auto link =
        std::find_if(model.links.begin(), model.links.end(), [](const Link& l) { return l.name == "bug"; });
    return link == model.links.end() ? nullptr : &*link;
}

std::vector<Solid> solids_of(const Model& model) {
    std::vector<Solid> out;
    each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
        for (const Collision& c : link.collisions)
            if (c.shape.kind != ShapeKind::plane) out.push_back({c.shape.kind, pose * c.pose, c.shape.size});
    });
    return out;
}

std::optional<double> common_height(const Solid& solid, double low, double high) {
    const double middle = solid.pose.translation().z(), half = solid.size.z() / 2;
    const double from = std::max(low, middle - half), to = std::min(high, middle + half);
    if (to - from < 0.001) return {};
    return solid.kind == ShapeKind::sphere ? std::clamp(middle, from, to) : (from + to) / 2;
}

std::vector<Obstacle> obstacles_of(const WorldDescription& world, const Heights& heights) {
    std::vector<Obstacle> out;
    each_static_collision(world, [&](const Collision& collision, const Solid& solid) {
        const std::size_t first = out.size();  // of this solid
        for (std::size_t layer = 0; layer < heights.ranges().size(); ++layer) {
            const auto& [low, high] = heights.ranges()[layer];
            const auto height = common_height(solid, low, high);
            if (!height) continue;
            const auto outline = cut(solid, *height);
            if (!outline) continue;
            // Upright solids are the same at all heights; spheres are not.
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
    each_static_collision(world, [&](const Collision&, const Solid& solid) {
        if (solid.kind == ShapeKind::cylinder && cut(solid, light_height) && !cut(solid, proximity_height))
            out.push_back(solid.pose.translation().head<2>());
    });
    return out;
}

std::vector<DrawnSolid> drawing_of(const WorldDescription& world) {
    std::vector<DrawnSolid> out;
    for (const Model& model : world.models)
        if (!robot_link(model) && !is_movable(model))
            each_link(model, Pose::Identity(), [&](const Link& link, const Pose& pose) {
                for (const Visual& v : link.visuals)
                    if (v.shape.kind != ShapeKind::plane)
                        out.push_back({{v.shape.kind, pose * v.pose, v.shape.size}, v.material.diffuse});
            });
    return out;
}

}  // namespace forage::bug
