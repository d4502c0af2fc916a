#include "bug_interface/simulation/world.h"

#include <array>
#include <cmath>

#include "bug_interface/motion/free_drive.h"
#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

/// Random numbers of whole control steps have other indices than those of substeps.
constexpr std::uint64_t first_free_index = std::uint64_t{1} << 62;

}  // namespace

std::uint64_t World::substeps_before(std::uint64_t cycle) const {
    // The tolerance compensates rounding errors: 80 substeps per cycle may be 79.999999.
    return static_cast<std::uint64_t>(std::floor(static_cast<double>(cycle) * substeps_per_cycle_ + 1e-4));
}

void World::step() {
    advance_bodies();
    scan();
    render();
}

/// The order within a substep is that of the original: the velocity plugin, the reset plugin, the motion, the
/// targets.
void World::advance_bodies() {
    const std::uint64_t last = substeps_before(cycle_ + 1);
    physics_->forget_touches();
    if (drive_freely(last)) substep_ = last;
    for (; substep_ < last; ++substep_) {
        for (std::size_t i = 0; i < robots_.size(); ++i) {
            drive(i);
            if (!robots_[i].hinges.empty()) robots_[i].move_gripper(*physics_, description_.step);
        }
        physics_->step(drives_);
        for (std::size_t i = 0; i < robots_.size(); ++i)
            if (!resetting(i)) robots_[i].trials->follow(physics_->pose(i));
        if (!game_.empty()) game_.substep(*physics_, time() + description_.step, description_.step);
        if (options_.sensor_rates) sense_due();
    }
    update_body_poses();
    ++cycle_;
}

/// Sets the command of the current substep.
void World::drive(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (update_reset(bug)) {
        drives_[bug] = {};
        return;
    }
    drives_[bug] = robot.command;
    if (!options_.noise) return;
    std::array<double, 2> u{};
    robot.motor_noise.uniform(substep_, u);
    drives_[bug].forward += (2 * u[0] - 1) * speed_noise;
    drives_[bug].turn += (2 * u[1] - 1) * speed_noise;
}

/// Simulates all substeps before number `last` at once. Returns false, and does nothing, when a robot may
/// touch something or when the substeps matter for another reason.
bool World::drive_freely(std::uint64_t last) {
    if (options_.sensor_rates || !game_.empty()) return false;  // these depend on every substep
    const std::uint64_t steps = last - substep_;
    const double seconds = static_cast<double>(steps) * description_.step,
                 noise = options_.noise ? speed_noise : 0;
    for (int pass = 0; pass < 2; ++pass)  // a measurement for one robot may reduce the clearance of another
        for (std::size_t i = 0; i < robots_.size(); ++i)
            if (!can_drive_freely(i, seconds)) return false;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        const MotorCommand& command = robot.command;
        const Pose2 from = physics_->pose(i);
        physics_->drive_freely(i,
                               free_drive(from, command, steps, description_.step, noise, robot.motor_noise,
                                          first_free_index + cycle_),
                               command, (std::abs(command.forward) + noise) * seconds,
                               (std::abs(command.turn) + noise) * seconds);
        robot.trials->follow(from, physics_->pose(i));
    }
    return true;
}

/// Whether a robot will only drive for `seconds`, far enough from all targets for the substeps not to matter.
bool World::can_drive_freely(std::size_t bug, double seconds) {
    constexpr double near_target = 1;  ///< m
    Robot& robot = robots_[bug];
    const double travel = (std::abs(robot.command.forward) + speed_noise) * seconds,
                 turn = (std::abs(robot.command.turn) + speed_noise) * seconds;
    if (resetting(bug) || !robot.hinges.empty() || !(turn < max_free_turn)) return false;
    const Eigen::Vector2d at(physics_->pose(bug).x, physics_->pose(bug).y);
    if (robot.reset) {
        const Eigen::AlignedBox2d& bounds = robot.reset->plan().bounds;
        if (!((at - bounds.min()).minCoeff() > travel && (bounds.max() - at).minCoeff() > travel))
            return false;
    }
    for (const Eigen::Vector2d& target : targets_)
        if ((target - at).squaredNorm() < (near_target + travel) * (near_target + travel)) return false;
    return physics_->can_drive_freely(bug, travel, turn);
}

/// Applies the reset rule in one substep. Returns true when the robot is not driven.
bool World::update_reset(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (!robot.reset) return false;
    switch (robot.reset->substep(physics_->pose(bug))) {
        case Reset::Phase::none:
            return false;
        case Reset::Phase::begin:
            robot.trials->finish(physics_->pose(bug), cycle_ + 1);
            physics_->remove(bug);
            return true;
        case Reset::Phase::hold:
            return true;
        case Reset::Phase::end:
            physics_->place(bug, robot.reset->start_pose());
            robot.trials->begin(physics_->pose(bug),
                                substep_ + 1 < substeps_before(cycle_ + 1) ? cycle_ : cycle_ + 1);
            return true;
    }
    return true;
}

/// A robot that is being reset is observed at a random start pose.
void World::update_body_poses() {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        body_poses_.bodies[i] = robot.pose = resetting(i) ? robot.reset->reset_pose() : physics_->pose(i);
        for (std::size_t h = 0; h < robot.hinges.size(); ++h)
            body_poses_.hinges[i][h] = robot.hinges.displacement(h);
    }
    for (std::size_t i = robots_.size(); i < bodies_.size(); ++i) {
        body_poses_.bodies[i] = physics_->pose(i);
        body_poses_.present[i] = physics_->present(i);
    }
    visuals_placed_ = false;
    if (description_.game) colour_resources();
}

/// Good resources have their own colour; bad ones are yellow.
void World::colour_resources() {
    static const Material bad = *named_material("Gazebo/Yellow");
    for (const Game::Resource& r : game_.resources()) {
        std::size_t visual = 0;  // of this resource
        for (MovingVisual& moving : moving_visuals_) {
            if (moving.body != r.body) continue;
            moving.visual.material =
                r.good ? movable_objects_[r.body - robots_.size()].visuals[visual].visual.material : bad;
            ++visual;
        }
    }
}

std::shared_ptr<void> World::claim(std::size_t bug) {
    if (!robots_[bug].claim.expired()) return nullptr;
    auto token = std::make_shared<int>();
    robots_[bug].claim = token;
    return token;
}

void World::checkpoint(Archive& archive) {
    archive.same(robots_.size(), "the number of robots");
    archive(cycle_, substep_);
    for (Robot& robot : robots_) robot.checkpoint(archive);
    archive(body_poses_, game_, *physics_);
    visuals_placed_ &= !archive.loading();
    if (archive.loading() && description_.game) colour_resources();
}

}  // namespace forage::bug
