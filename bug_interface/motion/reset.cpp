#include "bug_interface/motion/reset.h"

#include <array>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace forage::bug {
namespace {

constexpr double jitter = 0.01;  ///< m and rad

/// The bounding box of a shape in the plane, m.
Eigen::AlignedBox2d extent(const Shape& shape, const Pose& pose) {
    const Eigen::Vector3d half = pose.linear().cwiseAbs() * shape.size / 2;
    const Eigen::Vector2d centre = pose.translation().head<2>();
    return {centre - half.head<2>(), centre + half.head<2>()};
}

/// The bounds that the ground model gives. Reports an error and returns nothing when it gives none.
std::optional<Eigen::AlignedBox2d> bounds_of(const Model& ground, Diagnostics& diagnostics) {
    constexpr const char* hint = "add a box as its last collision, below the floor and as large as the arena";
    if (ground.links.empty() || ground.links.back().collisions.empty()) {
        diagnostics.error(ground.where, "the last link of GroundPlane has no collision that gives the bounds",
                          hint);
        return {};
    }
    const Link& link = ground.links.back();
    const Collision& last = link.collisions.back();
    if (last.shape.kind == ShapeKind::plane) {
        diagnostics.error(ground.where, "GroundPlane's last collision is a plane, so the arena has no bounds",
                          hint);
        return {};
    }
    return extent(last.shape, ground.pose * link.pose * last.pose);
}

/// Warns about names that are similar to start poses, and about names that occur twice.
void warn_about_names(const WorldDescription& world, Diagnostics& diagnostics) {
    constexpr std::string_view start = "Reset_";
    std::set<std::string_view> seen;
    for (const Model& model : world.models) {
        const std::string_view name = model.name;
        const bool is_start = name.starts_with(start);
        if (is_start && (name.size() != start.size() + 1 || name.back() < '0' || name.back() > '9'))
            diagnostics.warning(model.where,
                                fmt::format("'{}' is not a start pose: only Reset_0 to Reset_9 are", name),
                                "change its number; if it is not meant as a start pose, change its name");
        else if ((is_start || name == "GroundPlane") && !seen.insert(name).second)
            diagnostics.warning(model.where,
                                fmt::format("there are two models named '{}'; the first one is used", name),
                                "give each <include> a <name> of its own");
    }
}

}  // namespace

std::optional<ResetPlan> find_reset(const WorldDescription& world, Diagnostics& diagnostics) {
    warn_about_names(world, diagnostics);
    ResetPlan plan;
    std::vector<const Model*> starts;
    for (int i = 0; i < 10; ++i)
        if (const Model* start = find_model(world, fmt::format("Reset_{}", i))) {
            starts.push_back(start);
            plan.starts.push_back(in_plane(start->pose));
            plan.names.push_back(start->name);
        }
    if (starts.empty()) {
        if (world.trials)
            diagnostics.warning(world.trials->where,
                                "there are rules of trials, but no start poses, so no trials",
                                "add a start: a model named Reset_0 to Reset_9");
        return {};
    }
    const Model* ground = find_model(world, "GroundPlane");
    if (!ground) {
        diagnostics.error(
            starts.front()->where,
            fmt::format("there is a start pose '{}', but no model named GroundPlane that gives the bounds",
                        starts.front()->name),
            "add a floor named GroundPlane, or remove the Reset_i models");
        return {};
    }
    const auto bounds = bounds_of(*ground, diagnostics);
    if (!bounds) return {};
    plan.bounds = *bounds;
    if (world.trials) plan.heading = world.trials->heading;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const Eigen::Vector2d at(plan.starts[i].x, plan.starts[i].y);
        if (!plan.bounds.contains(at - Eigen::Vector2d::Constant(jitter)) ||
            !plan.bounds.contains(at + Eigen::Vector2d::Constant(jitter)))
            diagnostics.error(
                starts[i]->where,
                fmt::format("'{}' at ({}, {}) is not inside the bounds x {} to {}, y {} to {}",
                            starts[i]->name, at.x(), at.y(), plan.bounds.min().x(), plan.bounds.max().x(),
                            plan.bounds.min().y(), plan.bounds.max().y()),
                "a robot that starts there would be reset forever");
    }
    return plan;
}

Reset::Phase Reset::substep(const Pose2& pose, bool over) {
    if (left_ > 0) return --left_ == 0 ? Phase::end : Phase::hold;
    const auto& low = plan_.bounds.min();
    const auto& high = plan_.bounds.max();
    const bool outside = pose.x > high.x() || pose.y > high.y() || pose.x < low.x() || pose.y < low.y();
    if (!outside && !over) return Phase::none;
    left_ = substeps - 1;
    return Phase::begin;
}

Pose2 Reset::draw(std::uint64_t index) const {
    std::array<double, 4> u{};
    random_.uniform(index, u);
    const Pose2& start =
        plan_.starts[static_cast<std::size_t>(u[0] * static_cast<double>(plan_.starts.size()))];
    const auto off = [](double v, double most = jitter) { return (2 * v - 1) * most; };
    return {start.x + off(u[1]), start.y + off(u[2]), start.yaw + off(u[3], plan_.heading)};
}

}  // namespace forage::bug
