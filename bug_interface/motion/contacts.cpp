// The contacts of an island in a stride.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bug_interface/motion/bullet_contacts.h"
#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {

/// Changes the velocities of the active bodies of an island so that they do not move into anything within
/// `steps` steps. A driven body gets the velocity of its command in every step; for several steps at
/// once it is as many times as heavy.
void Physics::solve_contacts(std::span<const std::size_t> bodies, std::uint64_t steps) {
    active_.clear();
    for (const std::size_t i : bodies)
        if (states_[i].active) active_.push_back(i);
    const double seconds = static_cast<double>(steps) * step_;
    find_encounters(seconds);
    if (encounters_.empty()) return;
    std::swap(point_contacts_, contacts_before_);
    find_contacts(steps);
    begin_with_impulses_before(steps);
    if (contacts_ == Contacts::always_bullet)
        bullet_contacts_->solve(pushed_bodies_, point_contacts_, seconds);
    else
        contact_solver_.solve(pushed_bodies_, point_contacts_, seconds);
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

/// Finds the contacts of all encounters.
void Physics::find_contacts(std::uint64_t steps) {
    pushed_bodies_.clear(), point_contacts_.clear();
    for (const std::size_t i : active_) {
        const Body& b = bodies_[i];
        const Pose2& pose = states_[i].pose;
        const double mass = contact_mass(b, heaviest_) * (b.driven ? static_cast<double>(steps) : 1);
        number_[i] = pushed_bodies_.size();
        pushed_bodies_.push_back({pose.x, pose.y, mass, b.inertia * mass / b.mass, &velocities_[i]});
    }
    for (const Encounter& e : encounters_) {
        const auto& of_body = shapes(e.body);
        const auto test = [&](std::size_t p, std::size_t q, const Outline& other, double radius,
                              double friction, std::size_t number, std::size_t name) {
            const PlacedShape& shape = of_body[p];
            if (!closer_than(other, shape.outline, e.reach + radius + shape.bounding_radius)) return;
            const bool boxes = !shape.outline.round && !other.round;
            const double least = boxes ? 0 : -e.reach;  // Bullet finds contacts of boxes when they overlap
            const Overlap in = overlap(other, shape.outline, least);
            if (in.depth <= least) return;
            const auto add = [&](const Overlap& of_point, const Eigen::Vector2d& point, std::size_t index) {
                point_contacts_.push_back({{obstacles_.size() + e.body, p, name, q, index},
                                           number_[e.body],
                                           number,
                                           of_point,
                                           point,
                                           std::min(shape.friction, friction)});
            };
            if (boxes) {
                const auto points = box_contacts_->find(shape.outline, other);
                for (std::size_t i = 0; i < points.size(); ++i) add(points[i].overlap, points[i].point, i);
            } else {
                const Outline& disc = shape.outline.round ? shape.outline : other;
                const double to_surface = shape.outline.round ? -disc.radius : disc.radius;
                add(in, Eigen::Vector2d(disc.x, disc.y) + to_surface * in.normal, 0);
            }
            if (in.depth > -touch_distance) note_touch(e);
        };
        for (std::size_t p = 0; p < of_body.size(); ++p) {
            if (e.is_obstacle) {
                const Obstacle& o = obstacles_[e.other];
                if (o.layers >> of_body[p].layer & 1u)
                    test(p, 0, o.outline, bounding_radius(o.outline), o.friction, PointContact::fixed,
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
}

/// Contacts begin with the impulses that they had in the stride before, per step.
void Physics::begin_with_impulses_before(std::uint64_t steps) {
    const double ratio =
        static_cast<double>(steps) / static_cast<double>(std::exchange(steps_before_, steps));
    for (PointContact& c : point_contacts_) {
        const auto same = std::find_if(contacts_before_.begin(), contacts_before_.end(),
                                       [&](const PointContact& was) { return was.name == c.name; });
        if (same != contacts_before_.end()) c.push = same->push * ratio, c.rub = same->rub * ratio;
    }
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

}  // namespace forage::bug
