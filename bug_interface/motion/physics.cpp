#include "bug_interface/motion/physics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "bug_interface/motion/bullet_world.h"

namespace forage::bug {
namespace {

/// The same angle in (-pi, pi], rad.
double wrap_angle(double yaw) {
    if (yaw > -std::numbers::pi && yaw <= std::numbers::pi) return yaw + 0.0;  // no negative zero
    const double rest = std::remainder(yaw, 2 * std::numbers::pi);
    return rest <= -std::numbers::pi ? std::numbers::pi : rest;
}

/// `v` moved towards 0 by at most `change`.
double decelerated(double v, double change) { return v > change ? v - change : v < -change ? v + change : 0; }

}  // namespace

Physics::Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
                 Stepping stepping, std::vector<LayerMask> collision_masks)
    : obstacles_(obstacles.begin(), obstacles.end()),
      bodies_(bodies.begin(), bodies.end()),
      states_(bodies.size()),
      velocities_(bodies.size()),
      step_(step),
      stepping_(stepping),
      collision_masks_(std::move(collision_masks)),
      bullet_(std::make_unique<BulletWorld>(bodies.size())) {
    collision_masks_.resize(max_layers, ~LayerMask{0});
    std::size_t max_parts = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_[i].radius > 0) states_[i].layers |= LayerMask{1} << bodies_[i].layer;
        for (const Part& part : bodies_[i].parts) states_[i].layers |= LayerMask{1} << part.layer;
        update_bounding_radius(i);
        max_parts = std::max(max_parts, bodies_[i].parts.size());
        if (bodies_[i].driven) heaviest_ = std::max(heaviest_, bodies_[i].mass);
        shape_caches_.emplace_back().shapes.reserve(bodies_[i].parts.size() + 1);
    }
    std::vector<Area> covered;
    for (const Obstacle& o : obstacles_) {
        obstacle_shapes_.push_back({o.outline, 0, 0, bounding_radius(o.outline), o.friction});
        covered.push_back(Area::around(o.outline.x, o.outline.y, bounding_radius(o.outline)));
    }
    obstacle_grid_.assign(covered, 1);
    // Steps must not allocate memory.
    const std::size_t n = bodies_.size();
    states_before_.resize(n), velocities_before_.resize(n), corrections_.resize(n), reach_.resize(n);
    coasting_.resize(n), undisturbed_.resize(n);
    active_.reserve(n);
    near_.resize(n), root_.resize(n), members_.reserve(n), islands_.reserve(n), areas_.reserve(n);
    for (auto& near : near_) near.reserve(n);
    std::iota(root_.begin(), root_.end(), 0);
    outlines_before_.reserve(max_parts), pushed_.reserve(bodies_.size());
}

Physics::~Physics() = default;

void Physics::update_bounding_radius(std::size_t body) {
    State& state = states_[body];
    state.bounding_radius = std::max(state.bounding_radius, bodies_[body].radius);
    for (const Part& part : bodies_[body].parts)
        state.bounding_radius = std::max(state.bounding_radius, std::hypot(part.outline.x, part.outline.y) +
                                                                    bounding_radius(part.outline));
}

void Physics::place(std::size_t body, const Pose2& pose) {
    states_[body].pose = {pose.x, pose.y, wrap_angle(pose.yaw)};
    states_[body].present = true;
    velocities_[body] = {};
    states_[body].touching = states_[body].measured = false, states_[body].obstacle_clearance = 0;
}

void Physics::remove(std::size_t body) {
    states_[body].present = false;
    states_[body].robot_contacts = 0;
}

double Physics::speed(std::size_t body) const { return std::hypot(velocities_[body].x, velocities_[body].y); }

/// The motion of a movable object through some steps in which nothing touches it: the friction of the floor
/// reduces its velocity at the start of every step.
void Physics::coast(std::size_t body, std::uint64_t steps, Velocity& mean, Velocity& end) const {
    const Velocity v = velocities_[body];
    mean = end = v;
    if (is_zero(v)) return;
    const double n = static_cast<double>(steps);
    // The sum over the steps until it stops, as a fraction of n times the first value.
    const auto slow_down = [&](double value, double change) {
        const double moving = change > 0 ? std::min(n, std::floor(value / change)) : n;
        return (moving * value - change * moving * (moving + 1) / 2) / n;
    };
    const double speed = std::hypot(v.x, v.y), slower = bodies_[body].deceleration * step_,
                 turns_slower = bodies_[body].angular_deceleration * step_;
    if (speed > 0) {
        const double kept = slow_down(speed, slower) / speed, left = decelerated(speed, n * slower) / speed;
        mean.x *= kept, mean.y *= kept, end.x *= left, end.y *= left;
    }
    mean.turn = std::copysign(slow_down(std::abs(v.turn), turns_slower), v.turn);
    end.turn = decelerated(v.turn, n * turns_slower);
}

/// Moves a body with a constant velocity. What is pushed moves no further than islands were made for.
void Physics::move(std::size_t body, Velocity mean, double seconds) {
    State& s = states_[body];
    if (is_zero(mean)) return;  // shapes that overlap at rest stay where they are
    if (s.active) mean.x += corrections_[body].x() / seconds, mean.y += corrections_[body].y() / seconds;
    double distance = max_displacement(body, mean, seconds);
    const double allowed = push_ - s.displacement;
    if (s.active && distance > allowed) {
        seconds *= std::max(0.0, allowed) / distance;
        distance = std::max(0.0, allowed);
    }
    s.pose.x += mean.x * seconds;
    s.pose.y += mean.y * seconds;
    s.pose.yaw = wrap_angle(s.pose.yaw + mean.turn * seconds);
    s.moved(distance);
}

void Physics::move_freely(std::size_t island, const Pose2& pose, const Velocity& velocity) {
    const std::size_t i = members_[islands_[island].first];
    State& s = states_[i];
    s.touching = false;
    const double distance = static_cast<double>(steps_) * displacement_per_step(i);
    if (bodies_[i].driven) {
        s.pose = {pose.x, pose.y, wrap_angle(pose.yaw)};
        s.moved(distance);
        velocities_[i] = velocity;
    } else if (distance > 0) {
        Velocity mean, end;
        coast(i, steps_, mean, end);
        s.active = false;
        move(i, mean, static_cast<double>(steps_) * step_);
        velocities_[i] = end;
    }
}

void Physics::advance(std::size_t island, std::span<const Velocity> velocities, std::uint64_t steps) {
    if (make_stride(this->island(island), velocities, steps)) return;
    advance(island, velocities, steps / 2);
    advance(island, velocities, steps - steps / 2);
}

/// Moves bodies through some steps at once. Returns false, and changes nothing, when they must be made in
/// shorter strides.
bool Physics::make_stride(std::span<const std::size_t> members, std::span<const Velocity> velocities,
                          std::uint64_t steps) {
    const double seconds = static_cast<double>(steps) * step_;
    const bool always = stepping_ == Stepping::single;
    bool contacts = always;
    for (const std::size_t i : members) {
        State& s = states_[i];
        states_before_[i] = s, velocities_before_[i] = velocities_[i];
        s.active = always;
        s.contacts_in_stride = 0;
        corrections_[i].setZero();
        if (bodies_[i].driven)
            velocities_[i] = velocities[i];
        else
            coast(i, steps, velocities_[i], coasting_[i]), undisturbed_[i] = velocities_[i];
    }
    // A second pass is needed because a measurement for one body may reduce the clearance of another.
    for (int pass = 0; pass < 2; ++pass)
        for (const std::size_t i : members) {
            State& s = states_[i];
            if (s.active || (is_zero(velocities_[i]) && !bodies_[i].driven)) continue;
            if (may_touch_something(i, max_displacement(i, velocities_[i], seconds)))
                s.active = contacts = true;
        }
    if (contacts) {
        ++contact_steps_;
        activate_neighbours(members, seconds);
        solve_contacts(members, steps);
    }
    for (const std::size_t i : members) {
        const Velocity mean = velocities_[i];
        move(i, mean, seconds);
        if (!bodies_[i].driven && mean == undisturbed_[i]) velocities_[i] = coasting_[i];
        states_[i].touching = states_[i].active;
        states_[i].robot_contacts += static_cast<int>(steps) * states_[i].contacts_in_stride;
    }
    return !contacts || !undo_penetrations(members, steps);
}

void Physics::checkpoint(Archive& archive) {
    for (State& s : states_) {
        if (archive.loading()) s.measured = false;
        archive(s.pose, s.present, s.touching, s.obstacle_clearance, s.bounding_radius, s.layers,
                s.robot_contacts);
    }
    for (Velocity& v : velocities_) archive(v.x, v.y, v.turn);
    archive(contact_steps_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) checkpoint_parts(i, archive);
}

}  // namespace forage::bug
