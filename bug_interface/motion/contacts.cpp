// The contacts of an island in a stride: which there may be, and which solver gets them.
#include <algorithm>
#include <cmath>

#include "bug_interface/motion/contact_solver.h"
#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {

/// Changes the velocities of the active bodies of an island so that they do not move into anything within
/// `steps` steps. A driven body gets the velocity of its command anew in every step; for several steps at
/// once it is as many times as heavy.
void Physics::solve_contacts(std::span<const std::size_t> bodies, std::uint64_t steps) {
    active_.clear();
    for (const std::size_t i : bodies)
        if (states_[i].active) active_.push_back(i);
    const double seconds = static_cast<double>(steps) * step_;
    find_encounters(seconds);
    if (encounters_.empty()) return;
    if (contacts_ == Contacts::when_near && find_round_contacts(steps))
        round_contacts_.solve(seconds);
    else
        solve_with_bullet(steps);
}

void Physics::find_encounters(double seconds) {
    const auto reach = [&](std::size_t i) {
        return 2 * (near_distance + max_displacement(i, velocities_[i], seconds));
    };
    encounters_.clear();
    for (const std::size_t i : active_) {
        const State& s = states_[i];
        const double of_i = reach(i);
        for_each_obstacle_near(i, of_i, [&](const Obstacle& o, std::size_t number) {
            if (distance_to(o.outline, s.pose.x, s.pose.y) < s.bounding_radius + of_i)
                encounters_.push_back({i, number, true, of_i});
        });
        for (const std::size_t j : near_[i]) {
            const double of_both = of_i + reach(j);
            if (j < i && states_[j].active && circle_gap(i, j) < of_both)
                encounters_.push_back({i, j, false, of_both});
        }
    }
}

/// Finds the contacts of all encounters when each has a round side; returns false when there is one of two
/// boxes.
bool Physics::find_round_contacts(std::uint64_t steps) {
    round_contacts_.begin_stride(static_cast<double>(steps));
    for (const std::size_t i : active_) {
        const Body& b = bodies_[i];
        const Pose2& pose = states_[i].pose;
        const double mass = contact_mass(b, heaviest_) * (b.driven ? static_cast<double>(steps) : 1);
        number_[i] =
            round_contacts_.add_body(pose.x, pose.y, mass, b.inertia * mass / b.mass, velocities_[i]);
    }
    touching_.clear();
    bool round = true;
    for (const Encounter& e : encounters_) {
        const auto& of_body = shapes(e.body);
        const auto test = [&](std::size_t p, std::size_t q, const Outline& other, double radius,
                              double friction, std::size_t number, std::size_t name) {
            const PlacedShape& shape = of_body[p];
            if (!closer_than(other, shape.outline, e.reach + radius + shape.bounding_radius)) return;
            const Overlap in = overlap(other, shape.outline, -e.reach);
            if (in.depth <= -e.reach) return;
            if (!shape.outline.round && !other.round) {
                round = false;
                return;
            }
            const Outline& disc = shape.outline.round ? shape.outline : other;
            const double to_surface = shape.outline.round ? -disc.radius : disc.radius;
            const Eigen::Vector2d point = Eigen::Vector2d(disc.x, disc.y) + to_surface * in.normal;
            round_contacts_.add_contact({obstacles_.size() + e.body, p, name, q}, number_[e.body], number, in,
                                        point, std::min(shape.friction, friction));
            if (in.depth > -touch_distance) touching_.push_back(e);
        };
        for (std::size_t p = 0; round && p < of_body.size(); ++p) {
            if (e.is_obstacle) {
                const Obstacle& o = obstacles_[e.other];
                if (o.layers >> of_body[p].layer & 1u)
                    test(p, 0, o.outline, bounding_radius(o.outline), o.friction, RoundContacts::fixed,
                         e.other);
                continue;
            }
            const auto& of_other = shapes(e.other);
            for (std::size_t q = 0; q < of_other.size(); ++q)
                if (can_collide(LayerMask{1} << of_body[p].layer, of_other[q].layer))
                    test(p, q, of_other[q].outline, of_other[q].bounding_radius, of_other[q].friction,
                         number_[e.other], obstacles_.size() + e.other);
        }
    }
    if (!round) return false;
    for (const Encounter& e : touching_) note_touch(e);
    return true;
}

/// Notes that the bodies of an encounter touch each other at one point.
void Physics::note_touch(const Encounter& e) {
    const bool by_robot = bodies_[e.body].driven || (!e.is_obstacle && bodies_[e.other].driven);
    const auto note = [&](std::size_t i) {
        if (bodies_[i].driven && !touched_.empty()) touched_[i] = 1;
        if (!bodies_[i].driven && by_robot) ++states_[i].contacts_in_stride;
    };
    note(e.body);
    if (!e.is_obstacle) note(e.other);
}

void Physics::solve_with_bullet(std::uint64_t steps) {
    if (!contact_solver_)
        contact_solver_ = std::make_unique<ContactSolver>(obstacles_, bodies_, collision_masks_);
    pairs_.clear();
    const std::size_t first_body = obstacles_.size();
    for (const Encounter& e : encounters_)
        pairs_.emplace_back(e.is_obstacle ? e.other : first_body + e.other, first_body + e.body);
    std::sort(pairs_.begin(), pairs_.end());
    contact_solver_->solve(step_, steps, active_, pairs_, states_, velocities_, touched_);
}

}  // namespace forage::bug
