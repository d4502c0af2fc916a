#include "bug_interface/motion/physics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bug_interface/motion/contact_solver.h"
#include "bug_interface/motion/overlap.h"

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
                 Contacts contacts, std::vector<LayerMask> collision_masks)
    : obstacles_(obstacles.begin(), obstacles.end()),
      bodies_(bodies.begin(), bodies.end()),
      states_(bodies.size()),
      velocities_(bodies.size()),
      step_(step),
      contacts_(contacts),
      collision_masks_(std::move(collision_masks)) {
    collision_masks_.resize(max_layers, ~LayerMask{0});
    std::size_t most_parts = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_[i].radius > 0) states_[i].layers |= LayerMask{1} << bodies_[i].layer;
        for (const Part& part : bodies_[i].parts) states_[i].layers |= LayerMask{1} << part.layer;
        update_bounding_radius(i);
        most_parts = std::max(most_parts, bodies_[i].parts.size());
        shape_caches_.emplace_back().shapes.reserve(bodies_[i].parts.size() + 1);
    }
    // Steps must not allocate memory.
    poses_before_.resize(bodies_.size()), reverted_.reserve(bodies_.size());
    outlines_before_.reserve(most_parts), pushed_.reserve(bodies_.size());
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
    for (State& s : states_) s.clearance = 0;  // other bodies may be near this one now
}

void Physics::remove(std::size_t body) {
    states_[body].present = false;
    states_[body].robot_contacts = 0;
}

double Physics::speed(std::size_t body) const { return std::hypot(velocities_[body].x, velocities_[body].y); }

void Physics::set_velocity(std::size_t i, const MotorCommand& command) {
    State& s = states_[i];
    Velocity& v = velocities_[i];
    if (bodies_[i].driven) {
        s.update_rotation();
        v = {command.forward * s.cos_yaw, command.forward * s.sin_yaw, command.turn};
        return;
    }
    const double speed = std::hypot(v.x, v.y);
    const double ratio = speed > 0 ? decelerated(speed, bodies_[i].deceleration * step_) / speed : 0;
    v = {v.x * ratio, v.y * ratio, decelerated(v.turn, bodies_[i].angular_deceleration * step_)};
}

bool Physics::can_drive_freely(std::size_t body, double travel, double turn) {
    if (contacts_ == Contacts::always || !states_[body].present) return false;
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (!bodies_[i].driven && states_[i].present && !is_zero(velocities_[i])) return false;
    return !may_touch_something(body, max_displacement(body, travel, turn));
}

void Physics::drive_freely(std::size_t body, const Pose2& pose, const MotorCommand& command, double travel,
                           double turn) {
    State& s = states_[body];
    s.pose = {pose.x, pose.y, wrap_angle(pose.yaw)};
    s.robot_contacts = 0;
    s.clearance -= max_displacement(body, travel, turn);
    set_velocity(body, command);
}

void Physics::step(std::span<const MotorCommand> commands) {
    bool contacts = contacts_ == Contacts::always;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& s = states_[i];
        s.active = contacts_ == Contacts::always && s.present;
        s.robot_contacts = 0;
        if (s.present) set_velocity(i, bodies_[i].driven ? commands[i] : MotorCommand{});
    }
    // A second pass is needed because a measurement for one body may reduce the clearance of another.
    for (int pass = 0; pass < 2; ++pass)
        for (std::size_t i = 0; i < states_.size(); ++i) {
            State& s = states_[i];
            if (!s.present || s.active || (is_zero(velocities_[i]) && !bodies_[i].driven)) continue;
            const double travel = (bodies_[i].driven ? std::abs(commands[i].forward) : speed(i)) * step_;
            if (may_touch_something(i, max_displacement(i, travel, std::abs(velocities_[i].turn) * step_)))
                s.active = contacts = true;
        }
    if (contacts) {
        if (!contact_solver_)
            contact_solver_ = std::make_unique<ContactSolver>(obstacles_, bodies_, collision_masks_);
        ++contact_steps_;
        activate_neighbours();
        contact_solver_->solve(step_, states_, velocities_, touched_);
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& s = states_[i];
        if (!s.present) continue;
        poses_before_[i] = s.pose;
        const Velocity& v = velocities_[i];
        if (is_zero(v)) continue;
        s.pose.x += v.x * step_;
        s.pose.y += v.y * step_;
        s.pose.yaw = wrap_angle(s.pose.yaw + v.turn * step_);
        // A body may be pushed faster than its command.
        const double speed =
            s.active || !bodies_[i].driven ? std::sqrt(v.x * v.x + v.y * v.y) : std::abs(commands[i].forward);
        s.clearance -= max_displacement(i, speed * step_, std::abs(v.turn) * step_);
    }
    if (contacts) separate();
}

}  // namespace forage::bug
