#include "bug_interface/simulation/world.h"

#include <array>
#include <cmath>

#include "bug_interface/motion/free_drive.h"
#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

constexpr double speed_noise = 0.005;  ///< the velocity plugin adds up to this, m/s and rad/s

/// Draws of whole control steps, apart from those of substeps.
constexpr std::uint64_t first_free = std::uint64_t{1} << 62;

}  // namespace

std::uint64_t World::substeps_before(std::uint64_t cycle) const {
    // 80 substeps per cycle may be 79.999999 in floating point.
    return static_cast<std::uint64_t>(std::floor(static_cast<double>(cycle) * substeps_per_cycle_ + 1e-4));
}

void World::step() {
    advance_bodies();
    scan();
    render();
}

/// A substep, in the original's order: the velocity plugin, the reset plugin, then the motion, then the
/// targets.
void World::advance_bodies() {
    const std::uint64_t last = substeps_before(cycle_ + 1);
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
        if (options_.sensor_rates) sense_when_due();
    }
    update_body_poses();
    ++cycle_;
}

void World::drive(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (in_reset(bug)) {
        drives_[bug] = {};
        return;
    }
    drives_[bug] = robot.command;
    if (!options_.noise) return;
    std::array<double, 2> u{};
    robot.motor_random.uniform(substep_, u);
    drives_[bug].forward += (2 * u[0] - 1) * speed_noise;
    drives_[bug].turn += (2 * u[1] - 1) * speed_noise;
}

bool World::drive_freely(std::uint64_t last) {
    if (options_.sensor_rates || !game_.empty()) return false;  // somebody looks in between
    const std::uint64_t steps = last - substep_;
    const double seconds = static_cast<double>(steps) * description_.step,
                 noise = options_.noise ? speed_noise : 0;
    for (int pass = 0; pass < 2; ++pass)  // what one robot measures may leave less room for another one
        for (std::size_t i = 0; i < robots_.size(); ++i)
            if (!is_free(i, seconds)) return false;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        const MotorCommand& command = robot.command;
        const Pose2 from = physics_->pose(i);
        physics_->drive_freely(i,
                               free_drive(from, command, steps, description_.step, noise, robot.motor_random,
                                          first_free + cycle_),
                               command, (std::abs(command.forward) + noise) * seconds,
                               (std::abs(command.turn) + noise) * seconds);
        robot.trials->follow(from, physics_->pose(i));
    }
    return true;
}

/// Whether a robot will do nothing but drive for some seconds, too far from its target for the substeps to
/// matter.
bool World::is_free(std::size_t bug, double seconds) {
    constexpr double near_target = 1;  ///< m
    Robot& robot = robots_[bug];
    const double travel = (std::abs(robot.command.forward) + speed_noise) * seconds,
                 turn = (std::abs(robot.command.turn) + speed_noise) * seconds;
    if (resetting(bug) || !robot.hinges.empty() || !(turn < longest_free_turn)) return false;
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

bool World::in_reset(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (!robot.reset) return false;
    switch (robot.reset->substep(physics_->pose(bug))) {
        case Reset::Phase::none:
            return false;
        case Reset::Phase::begin:
            robot.trials->finish(physics_->pose(bug), cycle_ + 1);
            physics_->lift(bug);
            return true;
        case Reset::Phase::hold:
            return true;
        case Reset::Phase::end:
            physics_->place(bug, robot.reset->start());
            robot.trials->begin(physics_->pose(bug),
                                substep_ + 1 < substeps_before(cycle_ + 1) ? cycle_ : cycle_ + 1);
            return true;
    }
    return true;
}

/// Where everything is now. A robot that is being reset shows up somewhere.
void World::update_body_poses() {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        body_poses_.bodies[i] = robot.pose = resetting(i) ? robot.reset->reset_pose() : physics_->pose(i);
        for (std::size_t h = 0; h < robot.hinges.size(); ++h) body_poses_.hinges[i][h] = robot.hinges.frame(h);
    }
    for (std::size_t i = robots_.size(); i < bodies_.size(); ++i) {
        body_poses_.bodies[i] = physics_->pose(i);
        body_poses_.present[i] = physics_->present(i);
    }
    visuals_placed_ = false;
    if (description_.game) colour_resources();
}

/// Good ones have their own colour, bad ones are yellow.
void World::colour_resources() {
    static const Material bad = *named_material("Gazebo/Yellow");
    for (const Game::Resource& r : game_.resources()) {
        std::size_t part = 0;
        for (MovingVisual& moving : moving_visuals_) {
            if (moving.body != r.body) continue;
            moving.visual.material =
                r.good ? movable_objects_[r.body - robots_.size()].visuals[part].visual.material : bad;
            ++part;
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
