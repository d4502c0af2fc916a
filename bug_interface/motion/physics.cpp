#include "bug_interface/motion/physics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bug_interface/motion/contacts.h"
#include "bug_interface/motion/overlap.h"

namespace forage::bug {
namespace {

double wrapped(double yaw) {
    if (yaw > -std::numbers::pi && yaw <= std::numbers::pi) return yaw + 0.0;  // no negative zero
    const double rest = std::remainder(yaw, 2 * std::numbers::pi);
    return rest <= -std::numbers::pi ? std::numbers::pi : rest;
}

/// `v` nearer to 0 by up to `by`.
double slowed(double v, double by) { return v > by ? v - by : v < -by ? v + by : 0; }

}  // namespace

Physics::Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
                 Contacts contacts, std::vector<LayerMask> meets)
    : obstacles_(obstacles.begin(), obstacles.end()),
      bodies_(bodies.begin(), bodies.end()),
      states_(bodies.size()),
      velocities_(bodies.size()),
      step_(step),
      contacts_(contacts),
      meets_(std::move(meets)) {
    meets_.resize(most_layers, ~LayerMask{0});
    std::size_t most_parts = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        // Of which layers there are shapes that it can touch.
        if (bodies_[i].radius > 0) states_[i].layers |= LayerMask{1} << bodies_[i].layer;
        for (const Part& part : bodies_[i].parts) states_[i].layers |= LayerMask{1} << part.layer;
        grow(i);
        most_parts = std::max(most_parts, bodies_[i].parts.size());
        standing_.emplace_back().shapes.reserve(bodies_[i].parts.size() + 1);
    }
    // A step shall not allocate.
    began_.resize(bodies_.size()), stays_.reserve(bodies_.size());
    unswung_.reserve(most_parts), pushed_.reserve(bodies_.size());
}

Physics::~Physics() = default;

void Physics::grow(std::size_t body) {
    State& state = states_[body];
    state.reach = std::max(state.reach, bodies_[body].radius);
    for (const Part& part : bodies_[body].parts)
        state.reach = std::max(state.reach, std::hypot(part.outline.x, part.outline.y) + reach(part.outline));
}

void Physics::place(std::size_t body, const Pose2& pose) {
    states_[body].pose = {pose.x, pose.y, wrapped(pose.yaw)};
    states_[body].present = true;
    velocities_[body] = {};
    for (State& s : states_) s.room = 0;  // the others may be near it now
}

void Physics::lift(std::size_t body) {
    states_[body].present = false;
    states_[body].touches = 0;
}

double Physics::speed(std::size_t body) const { return std::hypot(velocities_[body].x, velocities_[body].y); }

void Physics::drive(std::size_t i, const MotorCommand& command) {
    State& s = states_[i];
    Velocity& v = velocities_[i];
    if (bodies_[i].driven) {
        s.face();
        v = {command.forward * s.cos_yaw, command.forward * s.sin_yaw, command.turn};
        return;
    }
    const double before = std::hypot(v.x, v.y);
    const double left = before > 0 ? slowed(before, bodies_[i].slowing * step_) / before : 0;
    v = {v.x * left, v.y * left, slowed(v.turn, bodies_[i].slowing_turn * step_)};
}

bool Physics::can_drive_freely(std::size_t body, double travel, double turn) {
    if (contacts_ == Contacts::always || !states_[body].present) return false;
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (!bodies_[i].driven && states_[i].present && !rests(velocities_[i])) return false;
    return !near_something(body, way(body, travel, turn));
}

void Physics::drive_freely(std::size_t body, const Pose2& pose, const MotorCommand& command, double travel,
                           double turn) {
    State& s = states_[body];
    s.pose = {pose.x, pose.y, wrapped(pose.yaw)};
    s.touches = 0;
    s.room -= way(body, travel, turn);
    drive(body, command);
}

void Physics::step(std::span<const MotorCommand> drives) {
    bool contacts = contacts_ == Contacts::always;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& s = states_[i];
        s.involved = contacts_ == Contacts::always && s.present;
        s.touches = 0;
        if (s.present) drive(i, bodies_[i].driven ? drives[i] : MotorCommand{});
    }
    // Twice: what one body measures may leave less room for another one.
    for (int pass = 0; pass < 2; ++pass)
        for (std::size_t i = 0; i < states_.size(); ++i) {
            State& s = states_[i];
            if (!s.present || s.involved || (rests(velocities_[i]) && !bodies_[i].driven)) continue;
            const double travel = (bodies_[i].driven ? std::abs(drives[i].forward) : speed(i)) * step_;
            if (near_something(i, way(i, travel, std::abs(velocities_[i].turn) * step_)))
                s.involved = contacts = true;
        }
    if (contacts) {
        if (!engine_) engine_ = std::make_unique<Engine>(obstacles_, bodies_, meets_);
        ++contact_steps_;
        involve_neighbours();
        engine_->solve(step_, states_, velocities_);
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& s = states_[i];
        if (!s.present) continue;
        began_[i] = s.pose;
        const Velocity& v = velocities_[i];
        if (rests(v)) continue;
        s.pose.x += v.x * step_;
        s.pose.y += v.y * step_;
        s.pose.yaw = wrapped(s.pose.yaw + v.turn * step_);
        // A body may be pushed faster than it is driven.
        const double speed =
            s.involved || !bodies_[i].driven ? std::sqrt(v.x * v.x + v.y * v.y) : std::abs(drives[i].forward);
        s.room -= way(i, speed * step_, std::abs(v.turn) * step_);
    }
    if (contacts) separate();
}

}  // namespace forage::bug
