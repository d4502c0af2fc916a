// The contacts of an island in a stride: which there may be, and which solver gets them.
#include <algorithm>
#include <cmath>

#include "bug_interface/motion/contact_solver.h"
#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {

/// Changes the velocities of the active bodies of an island so that they do not move into anything within
/// `steps` steps. A driven body gets the velocity of its command anew in every step; for several steps at once
/// it is as many times as heavy.
void Physics::solve_contacts(std::span<const std::size_t> bodies, std::uint64_t steps) {
    active_.clear();
    bool round = contacts_ == Contacts::when_near;
    for (const std::size_t i : bodies)
        if (states_[i].active) active_.push_back(i), round &= is_round(i);
    find_encounters(static_cast<double>(steps) * step_);
    if (encounters_.empty()) return;
    if (round)
        solve_round(steps);
    else
        solve_with_bullet(steps);
}

void Physics::find_encounters(double seconds) {
    const auto reach = [&](std::size_t i) {
        const Velocity& v = velocities_[i];
        return 2 * (near_distance +
                    max_displacement(i, std::hypot(v.x, v.y) * seconds, std::abs(v.turn) * seconds));
    };
    encounters_.clear();
    for (const std::size_t i : active_) {
        const State& s = states_[i];
        const double of_i = reach(i);
        for_each_obstacle_near(i, of_i, [&](const Obstacle& o, std::size_t number) {
            if (distance_to(o.outline, s.pose.x, s.pose.y) < s.bounding_radius + of_i)
                encounters_.push_back({i, number, true});
        });
        for (const std::size_t j : near_[i])
            if (j < i && states_[j].active && circle_gap(i, j) < of_i + reach(j))
                encounters_.push_back({i, j, false});
    }
}

void Physics::solve_round(std::uint64_t steps) {
    round_contacts_.begin_stride(static_cast<double>(steps));
    for (const std::size_t i : active_) {
        const Body& b = bodies_[i];
        const double mass = contact_mass(b, heaviest_) * (b.driven ? static_cast<double>(steps) : 1);
        disc_[i] = round_contacts_.add_disc(b.radius, mass, b.inertia * mass / b.mass, velocities_[i]);
    }
    const auto disc_of = [&](std::size_t body) {
        Outline disc;
        disc.round = true, disc.radius = bodies_[body].radius;
        disc.x = states_[body].pose.x, disc.y = states_[body].pose.y;
        return disc;
    };
    for (const Encounter& e : encounters_) {
        const Body& body = bodies_[e.body];
        const Outline disc = disc_of(e.body);
        Overlap in;
        if (e.is_obstacle) {
            const Obstacle& o = obstacles_[e.other];
            in = overlap(o.outline, disc);
            round_contacts_.add_contact({e.other, obstacles_.size() + e.body}, disc_[e.body], in,
                                        std::min(body.friction, o.friction));
        } else {
            const Body& other = bodies_[e.other];
            if (!can_collide(LayerMask{1} << body.layer, other.layer)) continue;
            in = overlap(disc_of(e.other), disc);
            round_contacts_.add_contact({obstacles_.size() + e.other, obstacles_.size() + e.body}, disc_[e.body], disc_[e.other], in,
                                        std::min(body.friction, other.friction));
        }
        if (in.depth <= -touching) continue;
        const auto note = [&](std::size_t i, bool by_robot) {
            if (bodies_[i].driven && !touched_.empty()) touched_[i] = 1;
            if (!bodies_[i].driven && by_robot) ++states_[i].contacts_in_stride;
        };
        note(e.body, !e.is_obstacle && bodies_[e.other].driven);
        if (!e.is_obstacle) note(e.other, body.driven);
    }
    round_contacts_.solve(static_cast<double>(steps) * step_);
}

void Physics::solve_with_bullet(std::uint64_t steps) {
    if (!contact_solver_)
        contact_solver_ = std::make_unique<ContactSolver>(obstacles_, bodies_, collision_masks_);
    pairs_.clear();
    const std::size_t first_body = obstacles_.size();
    for (const Encounter& e : encounters_)
        pairs_.push_back({e.is_obstacle ? e.other : first_body + e.other, first_body + e.body});
    std::sort(pairs_.begin(), pairs_.end());
    contact_solver_->solve(step_, steps, active_, pairs_, states_, velocities_, touched_);
}

}  // namespace forage::bug
