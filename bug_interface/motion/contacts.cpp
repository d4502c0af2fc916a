// The contacts of an island in a stride, which Bullet solves, and what happens when that was not enough.
#include <algorithm>

#include "bug_interface/motion/bullet_world.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double touch_distance = 0.0005;  ///< m; shapes closer than this touch
constexpr double max_depth = 8e-4;         ///< m; a stride must not make shapes penetrate each other deeper
constexpr double depth_tolerance = 1e-6;   ///< m; above the errors of Bullet's single precision

}  // namespace

/// Changes the velocities of the active bodies of an island so that they do not move into anything within
/// `steps` steps. A driven body gets the velocity of its command in every step; for several steps at
/// once it is as many times as heavy.
void Physics::solve_contacts(std::span<const std::size_t> bodies, std::uint64_t steps) {
    const double seconds = static_cast<double>(steps) * step_;
    active_.clear();
    for (const std::size_t i : bodies)
        if (states_[i].active) active_.push_back(i);
    bullet_->begin(states_[active_.front()].pose);
    for (const std::size_t i : active_) {
        const Body& b = bodies_[i];
        const double mass = contact_mass(b, heaviest_) * (b.driven ? static_cast<double>(steps) : 1);
        bullet_->add_body(i, states_[i].pose, mass, b.inertia * mass / b.mass, velocities_[i]);
    }
    const auto reach = [&](std::size_t i) {
        return 2 * (near_distance + max_displacement(i, velocities_[i], seconds));
    };
    for (const std::size_t i : active_) {
        const double of_i = reach(i);
        for_each_obstacle_pair(i, of_i, [&](const PlacedShape& shape, const PlacedShape& obstacle) {
            add_contacts(i, shape, BulletWorld::no_body, obstacle, of_i);
        });
        for (const std::size_t j : near_[i]) {
            if (j > i || !states_[j].active) continue;
            const double of_both = of_i + reach(j);
            for_each_pair(i, j, of_both, [&](const PlacedShape& shape, const PlacedShape& other) {
                add_contacts(i, shape, j, other, of_both);
            });
        }
    }
    if (!bullet_->has_contacts()) return;
    bullet_->solve(seconds);
    for (const std::size_t i : active_) {
        bullet_->update(i, velocities_[i]);
        corrections_[i] = bullet_->correction(i, states_[i].pose);
    }
}

/// Gives Bullet the contacts of a shape of body a and one of body b, or of an obstacle, and notes a touch.
void Physics::add_contacts(std::size_t a, const PlacedShape& of_a, std::size_t b, const PlacedShape& of_b,
                           double within) {
    const double friction = std::min(of_a.friction, of_b.friction);
    if (bullet_->add_contacts(of_a.outline, a, of_b.outline, b, friction, within) > touch_distance) return;
    const bool is_obstacle = b == BulletWorld::no_body;
    const bool by_robot = bodies_[a].driven || (!is_obstacle && bodies_[b].driven);
    const auto note = [&](std::size_t i) {
        if (bodies_[i].driven && !touched_.empty()) touched_[i] = 1;
        if (!bodies_[i].driven && by_robot) ++states_[i].contacts_in_stride;
    };
    note(a);
    if (!is_obstacle) note(b);
}

/// Whether shapes of two bodies penetrate each other too deeply, and deeper than before the stride.
bool Physics::penetrates(std::size_t a, std::size_t b) {
    bool deeper = false;
    const auto test = [&](const PlacedShape& p, const PlacedShape& q) {
        if (deeper) return;
        const double depth = -bullet_->gap(p.outline, q.outline).distance;
        if (depth <= max_depth) return;
        const Outline q_before = b < bodies_.size() ? outline(b, q.index, states_before_[b].pose) : q.outline;
        const Outline p_before = outline(a, p.index, states_before_[a].pose);
        deeper = depth > depth_tolerance - bullet_->gap(p_before, q_before).distance;
    };
    if (b < bodies_.size())
        for_each_pair(a, b, 0, test);
    else
        for_each_obstacle_pair(a, 0, test);
    return deeper;
}

/// Calls visit(a, b) for bodies that have come to penetrate each other too deeply; b is the number of bodies
/// when that is an obstacle. Ends when a visit returns true.
template <class F>
void Physics::for_each_penetration(std::span<const std::size_t> bodies, F&& visit) {
    for (const std::size_t a : bodies) {
        if (!states_[a].active) continue;
        if (penetrates(a, bodies_.size()) && visit(a, bodies_.size())) return;
        for (const std::size_t b : near_[a])
            if ((b < a || !states_[b].active) && penetrates(a, b) && visit(a, b)) return;
    }
}

/// Restores what was before a stride of several steps if shapes penetrate each other after it, as the stride
/// must be shorter; returns true then. After one step, the bodies that penetrate each other return to where
/// they were, at rest.
bool Physics::undo_penetrations(std::span<const std::size_t> bodies, std::uint64_t steps) {
    bool undone = false;
    const auto has_moved = [&](std::size_t i) {
        const Pose2 &now = states_[i].pose, &before = states_before_[i].pose;
        return now.x != before.x || now.y != before.y || now.yaw != before.yaw;
    };
    const auto restore = [&](std::size_t i) {
        if (i < bodies_.size()) states_[i] = states_before_[i], velocities_[i] = velocities_before_[i];
    };
    if (steps > 1) {
        for_each_penetration(bodies, [&](std::size_t, std::size_t) { return undone = true; });
        if (undone) std::for_each(bodies.begin(), bodies.end(), restore);
        return undone;
    }
    for (bool more = true; more;) {
        more = false;
        for_each_penetration(bodies, [&](std::size_t a, std::size_t b) {
            for (const std::size_t i : {a, b})
                if (i < bodies_.size() && has_moved(i))
                    restore(i), states_[i].active = more = true, velocities_[i] = {};
            return false;
        });
    }
    return false;
}

}  // namespace forage::bug
