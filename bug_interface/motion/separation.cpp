// After a step no two shapes penetrate each other by more than 0.8 mm, or by more than before the step.
//
// The solver changes velocities only. Contacts of two boxes are found only once they overlap, and a solution
// is approximate where a body is squeezed from several sides. The functions in this file separate shapes that
// penetrate each other after a step. They push them further apart than they must, as several bodies that
// press on each other would otherwise take many rounds. Bodies that cannot be separated return to their poses
// before the step.
#include <algorithm>
#include <cmath>

#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double least_depth = 7.5e-4;   ///< m; shapes that penetrate each other deeper are separated
constexpr double target_depth = 5e-4;    ///< m; separation reduces the depth to this
constexpr double max_depth = 8e-4;       ///< m; accepted when separation does not converge
constexpr double depth_epsilon = 1e-12;  ///< m; smaller excesses are ignored
constexpr int max_rounds = 20;           ///< largest number of passes over all pairs

}  // namespace

/// Calls visit(a, shape of a, b, shape of b, overlap) for each pair of shapes of an island that penetrate
/// each other by more than least_depth, when body a or b is active. For an obstacle, b is the number of
/// bodies and its shape is the number of the obstacle. visit() may move both bodies.
template <class F>
void Physics::for_each_penetration(std::span<const std::size_t> bodies, F&& visit) {
    const auto test = [&](std::size_t a, std::size_t p, const PlacedShape& shape_a, const Outline& outline_b,
                          double radius_b, std::size_t b, std::size_t q) {
        if (!closer_than(outline_b, shape_a.outline, radius_b + shape_a.bounding_radius)) return;
        const Overlap in = overlap(outline_b, shape_a.outline, least_depth);
        if (in.depth <= least_depth + depth_epsilon) return;
        visit(a, p, b, q, in);
        shapes(a);  // updates the shapes that the loops below refer to
        if (b < bodies_.size()) shapes(b);
    };
    for (const std::size_t a : bodies) {
        const State& s = states_[a];
        if (s.active)
            for_each_obstacle_near(a, 0, [&](const Obstacle& o, std::size_t number) {
                const double radius = bounding_radius(o.outline);
                const auto& of_a = shapes(a);
                for (std::size_t p = 0; p < of_a.size(); ++p)
                    if (o.layers >> of_a[p].layer & 1u)
                        test(a, p, of_a[p], o.outline, radius, bodies_.size(), number);
            });
        for (const std::size_t b : near_[a]) {
            if (b >= a || !(s.active || states_[b].active) || circle_gap(a, b) >= 0) continue;
            const auto &of_a = shapes(a), &of_b = shapes(b);
            for (std::size_t p = 0; p < of_a.size(); ++p)
                for (std::size_t q = 0; q < of_b.size(); ++q)
                    if (can_collide(LayerMask{1} << of_a[p].layer, of_b[q].layer))
                        test(a, p, of_a[p], of_b[q].outline, of_b[q].bounding_radius, b, q);
        }
    }
}

/// The penetration depth of two shapes before the step, m.
double Physics::depth_before_step(std::size_t a, std::size_t p, std::size_t b, std::size_t q) const {
    const auto outline_before = [&](std::size_t body, std::size_t shape) {
        const std::size_t discs = bodies_[body].radius > 0 ? 1 : 0;
        if (shape >= discs)
            return Transform2(poses_before_[body]) * bodies_[body].parts[shape - discs].outline;
        Outline outline = shape_caches_[body].shapes[shape].outline;
        outline.x = poses_before_[body].x, outline.y = poses_before_[body].y;
        return outline;
    };
    const Outline other = b < bodies_.size() ? outline_before(b, q) : obstacles_[q].outline;
    return overlap(other, outline_before(a, p)).depth;
}

void Physics::translate(std::size_t body, double x, double y) {
    State& s = states_[body];
    s.pose.x += x, s.pose.y += y;
    s.active = true;  // the velocities before the contacts were solved may not have reached this body
    s.moved(std::sqrt(x * x + y * y));
}

/// Moves bodies apart that penetrate each other. Pairs in which neither body moved in the step are left
/// alone: worlds may place bodies inside each other.
void Physics::separate(std::span<const std::size_t> bodies) {
    const auto unmoved = [&](std::size_t i) {
        if (i == bodies_.size()) return true;
        const Pose2 &now = states_[i].pose, &before = poses_before_[i];
        return now.x == before.x && now.y == before.y && now.yaw == before.yaw;
    };
    for (int round = 0; round < max_rounds; ++round) {
        bool moved = false;
        for_each_penetration(
            bodies, [&](std::size_t a, std::size_t p, std::size_t b, std::size_t q, const Overlap& in) {
                if (unmoved(a) && unmoved(b)) return;
                const double before = depth_before_step(a, p, b, q);
                const double excess = in.depth - (before > max_depth ? before : target_depth);
                if (excess <= depth_epsilon) return;
                moved = true;
                const double share = b < bodies_.size() ? excess / 2 : excess;
                translate(a, share * in.normal.x(), share * in.normal.y());
                if (b < bodies_.size()) translate(b, -share * in.normal.x(), -share * in.normal.y());
            });
        if (!moved) return;
    }
    revert_penetrating(bodies);
}

/// Puts bodies that still penetrate another shape too deeply back to their poses before the step, at rest.
/// The depths before the step were acceptable, so this ends at the latest when all bodies are back.
void Physics::revert_penetrating(std::span<const std::size_t> bodies) {
    reverted_.assign(states_.size(), 0);
    for (bool more = true; more;) {
        more = false;
        const auto revert = [&](std::size_t i) {
            if (i == bodies_.size() || reverted_[i]) return;
            reverted_[i] = more = true;
            states_[i].pose = poses_before_[i], states_[i].active = true;
            velocities_[i] = {};
        };
        for_each_penetration(
            bodies, [&](std::size_t a, std::size_t p, std::size_t b, std::size_t q, const Overlap& in) {
                if (in.depth > depth_epsilon + std::max(max_depth, depth_before_step(a, p, b, q)))
                    revert(a), revert(b);
            });
    }
}

}  // namespace forage::bug
