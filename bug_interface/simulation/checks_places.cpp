#include <algorithm>

#include <fmt/format.h>

#include "bug_interface/simulation/checks.h"
#include "bug_interface/simulation/movable_object.h"
#include "bug_interface/simulation/world_queries.h"

namespace forage::bug {
namespace {

/// Warns about robots and targets outside the bounds.
void check_bounds(const WorldDescription& world, const ResetPlan& plan, Diagnostics& diagnostics) {
    const std::string bounds =
        fmt::format("the bounds are x {:g} to {:g}, y {:g} to {:g}", plan.bounds.min().x(),
                    plan.bounds.max().x(), plan.bounds.min().y(), plan.bounds.max().y());
    for (const Model& model : world.models) {
        const Eigen::Vector2d at = model.pose.translation().head<2>();
        if (has_plugin(model, "libreset_plugin.so") && robot_link(model) && !plan.bounds.contains(at))
            diagnostics.warning(
                model.where,
                fmt::format("robot '{}' starts outside the bounds and is reset at once", model.name), bounds);
        WorldDescription alone;
        alone.models.push_back(model);
        for (const Eigen::Vector2d& target : targets_of(alone))
            if (plan.bounds.exteriorDistance(target) >= world.trials.value_or(TrialRules()).reach)
                diagnostics.warning(
                    model.where,
                    fmt::format("no robot can reach the target at ({:g}, {:g}): it is reset before",
                                target.x(), target.y()),
                    bounds);
    }
}

/// Warns about models above all robots, and about movable objects below the floor.
void check_heights(const Model& model, double top, Diagnostics& diagnostics) {
    const auto solids = solids_of(model);
    if (solids.empty()) return;
    double low = 1e9, high = -1e9;
    for (const Solid& s : solids) {
        low = std::min(low, s.pose.translation().z() - s.size.z() / 2);
        high = std::max(high, s.pose.translation().z() + s.size.z() / 2);
    }
    if (low < top && !(is_movable(model) && high <= 0)) return;
    diagnostics.warning(
        model.where,
        fmt::format("'{}' is {:.3g} to {:.3g} m above the floor: nothing touches it and no ray meets it",
                    model.name, low, high),
        "the third number of a <pose> is the height in m; the floor is at 0");
}

}  // namespace

void check_places(const WorldDescription& world, const std::optional<ResetPlan>& plan, double top,
                  Diagnostics& diagnostics) {
    if (plan) check_bounds(world, *plan, diagnostics);
    for (const Model& model : world.models)
        if (!robot_link(model) && top > 0) check_heights(model, top, diagnostics);
}

}  // namespace forage::bug
