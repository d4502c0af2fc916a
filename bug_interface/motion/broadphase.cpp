// Broad phase: which bodies Bullet has to consider in a step.
//
// Every body has a clearance. The gap between any two bodies is at least the sum of their clearances. Motion
// reduces the clearance of a body; it is measured again when it is too small for the next step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double near_distance = 0.001;  ///< m; well above the errors of Bullet's single precision
/// Gap between bounding circles below which the shapes are compared, m.
constexpr double shape_test_distance = 0.1;

/// Distance from the point (x, y) to an outline, m; 0 inside.
double distance_to(const Outline& o, double x, double y) {
    const double dx = x - o.x, dy = y - o.y;
    if (o.round) return std::max(0.0, std::sqrt(dx * dx + dy * dy) - o.radius);
    const double out_x = std::max(0.0, std::abs(o.cos_yaw * dx + o.sin_yaw * dy) - o.half_x);
    const double out_y = std::max(0.0, std::abs(o.cos_yaw * dy - o.sin_yaw * dx) - o.half_y);
    return std::sqrt(out_x * out_x + out_y * out_y);
}

}  // namespace

/// Gap between the bounding circles of two bodies, m; negative when they overlap.
double Physics::circle_gap(std::size_t a, std::size_t b) const {
    const Pose2 &at_a = states_[a].pose, &at_b = states_[b].pose;
    const double dx = at_b.x - at_a.x, dy = at_b.y - at_a.y;
    return std::sqrt(dx * dx + dy * dy) - states_[a].bounding_radius - states_[b].bounding_radius;
}

/// Distance of the outermost point of a body from its rotation axis, m; 0 for a disc, which a rotation does
/// not change.
double Physics::lever_arm(std::size_t body) const {
    return bodies_[body].parts.empty() ? 0 : states_[body].bounding_radius;
}

/// The shapes of a body in world coordinates: the central disc, then the parts.
const std::vector<Physics::PlacedShape>& Physics::shapes(std::size_t body) {
    ShapeCache& cache = shape_caches_[body];
    State& state = states_[body];
    const Pose2& pose = state.pose;
    if (cache.valid && cache.pose.x == pose.x && cache.pose.y == pose.y && cache.pose.yaw == pose.yaw)
        return cache.shapes;
    cache.shapes.clear();
    state.update_rotation();
    for_each_shape(body, Transform2(pose.x, pose.y, state.cos_yaw, state.sin_yaw),
                   [&](const Outline& outline, int layer) {
                       cache.shapes.push_back({outline, layer, bounding_radius(outline)});
                   });
    cache.pose = pose, cache.valid = true;
    return cache.shapes;
}

/// A lower bound of the gap between the shapes of two bodies, m; never below circle_gap().
double Physics::shape_gap(std::size_t a, std::size_t b) {
    double gap = std::numeric_limits<double>::infinity();
    for (const PlacedShape& p : shapes(a))
        for (const PlacedShape& q : shapes(b)) {
            // Most shapes are far from each other, and their bounding circles show it.
            const double limit = gap + p.bounding_radius + q.bounding_radius;
            if (limit >= 0 && !closer_than(p.outline, q.outline, limit)) continue;
            if (can_collide(LayerMask{1} << p.layer, q.layer))
                gap = std::min(gap, -overlap(p.outline, q.outline).depth);
        }
    return std::max(gap, circle_gap(a, b));
}

/// Whether the shapes of two bodies may be closer to each other than `distance`, m.
bool Physics::may_be_closer_than(std::size_t a, std::size_t b, double distance) {
    if (circle_gap(a, b) >= distance) return false;
    for (const PlacedShape& p : shapes(a))
        for (const PlacedShape& q : shapes(b))
            if (closer_than(p.outline, q.outline, distance + p.bounding_radius + q.bounding_radius) &&
                can_collide(LayerMask{1} << p.layer, q.layer) &&
                overlap(p.outline, q.outline, -distance).depth > -distance)
                return true;
    return false;
}

/// Sets the clearance of a body to the smallest gap to an obstacle and to half the smallest gap to a body.
/// The clearances of the other bodies shrink to half the gap, too.
void Physics::measure_clearance(std::size_t body) {
    State& state = states_[body];
    double clearance = std::numeric_limits<double>::infinity();
    for (const Obstacle& o : obstacles_) {
        if (!(o.layers & state.layers)) continue;
        double gap = distance_to(o.outline, state.pose.x, state.pose.y) - state.bounding_radius;
        if (gap >= clearance) continue;
        if (gap < shape_test_distance && lever_arm(body) > 0) {
            double of_shapes = std::numeric_limits<double>::infinity();
            for (const PlacedShape& shape : shapes(body))
                if (o.layers >> shape.layer & 1u)
                    of_shapes = std::min(of_shapes, -overlap(o.outline, shape.outline).depth);
            gap = std::max(gap, of_shapes);
        }
        clearance = std::min(clearance, gap);
    }
    for (std::size_t other = 0; other < states_.size(); ++other) {
        if (other == body || !states_[other].present) continue;
        double gap = circle_gap(body, other);
        if (gap < shape_test_distance && lever_arm(body) + lever_arm(other) > 0) gap = shape_gap(body, other);
        clearance = std::min(clearance, gap / 2);
        states_[other].clearance = std::min(states_[other].clearance, gap / 2);
    }
    state.clearance = clearance;
}

/// Whether a body may touch something while no point of it moves by more than `displacement`, m.
bool Physics::may_touch_something(std::size_t body, double displacement) {
    if (states_[body].clearance >= displacement + near_distance) return false;
    measure_clearance(body);
    return states_[body].clearance < displacement + near_distance;
}

/// Whether parts of a body can move by `displacement` (m) without touching anything. Other bodies may have
/// moved further than their clearance; that is subtracted.
bool Physics::has_clearance(std::size_t body, double displacement) {
    double deficit = 0;
    for (const State& s : states_)
        if (s.present) deficit = std::max(deficit, -s.clearance);
    const double needed = displacement + deficit + near_distance;
    if (states_[body].clearance < needed) measure_clearance(body);
    return states_[body].clearance >= needed;
}

/// An upper bound of the displacement of any point of a body that travels `travel` (m) and turns by `turn`
/// (rad), m.
double Physics::max_displacement(std::size_t body, double travel, double turn) const {
    return travel + turn * lever_arm(body);
}

/// Activates the bodies near active ones, as they may be pushed.
void Physics::activate_neighbours() {
    const auto speed_bound = [&](std::size_t i) {
        const Velocity& v = velocities_[i];
        return max_displacement(i, std::sqrt(v.x * v.x + v.y * v.y), std::abs(v.turn));
    };
    for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            if (!states_[i].active) continue;
            for (std::size_t j = 0; j < states_.size(); ++j) {
                State& other = states_[j];
                if (other.active || !other.present) continue;
                const double distance = 4 * near_distance + 2 * step_ * (speed_bound(i) + speed_bound(j));
                if (may_be_closer_than(i, j, distance)) other.active = more = true;
            }
        }
    }
}

}  // namespace forage::bug
