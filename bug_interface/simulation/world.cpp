#include "bug_interface/simulation/world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bug_interface/motion/free_drive.h"
#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

/// Random numbers of control steps and of other strides have other indices than those of substeps.
constexpr std::uint64_t first_free_index = std::uint64_t{1} << 62,
                        first_stride_index = std::uint64_t{1} << 61;

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
/// targets. Substeps are simulated together where that changes nothing.
void World::advance_bodies() {
    const std::uint64_t last = substeps_before(cycle_ + 1);
    physics_->forget_touches();
    const bool by_substep = every_substep_matters(last - substep_);
    while (substep_ < last) {
        std::uint64_t steps = by_substep ? 1 : last - substep_;
        if (!game_.empty()) steps = std::min(steps, game_.substeps_to_event(description_.step));
        move_bodies(steps);
        substep_ += steps;
        if (!game_.empty()) game_.advance(*physics_, time(), description_.step, steps);
        if (options_.sensor_rates) sense_due();
    }
    update_body_poses();
    ++cycle_;
}

/// Whether a robot may begin or end a reset within `steps` substeps, or sensors have rates of their own.
bool World::every_substep_matters(std::uint64_t steps) const {
    if (options_.sensor_rates) return true;
    const auto travel = [&](const Robot& robot) {
        return (std::abs(robot.command.forward) + speed_noise) * description_.step *
               static_cast<double>(steps);
    };
    double pushed = 0;  // another robot may push a robot at most twice as far as the fastest one drives
    if (bodies_.size() > 1)
        for (const Robot& robot : robots_) pushed = std::max(pushed, 2 * travel(robot));
    return std::ranges::any_of(robots_, [&](const Robot& robot) {
        if (!robot.reset) return false;
        if (robot.reset->running() || is_over(robot.number)) return true;
        if (description_.trials && may_reach_target(robot.number, steps)) return true;
        const double margin = std::max(pushed, travel(robot));
        const Eigen::Vector2d at(physics_->pose(robot.number).x, physics_->pose(robot.number).y);
        const Eigen::AlignedBox2d& bounds = robot.reset->plan().bounds;
        return !((at - bounds.min()).minCoeff() > margin && (bounds.max() - at).minCoeff() > margin);
    });
}

/// Moves all bodies through some substeps, island by island.
void World::move_bodies(std::uint64_t steps) {
    const double noise = options_.noise ? speed_noise : 0;
    for (Robot& robot : robots_) {
        robot.retry_hinges();
        const bool driven = !update_reset(robot.number);
        driven_[robot.number] = driven;
        const MotorCommand command = driven ? robot.command : MotorCommand{};
        const double speed_of_noise = driven ? noise : 0;
        reach_[robot.number] = {(std::abs(command.forward) + speed_of_noise) * description_.step,
                                (std::abs(command.turn) + speed_of_noise) * description_.step,
                                robot.gripper_travel(description_.step)};
    }
    physics_->begin(reach_, steps);
    for (std::size_t island = 0; island < physics_->islands(); ++island) move_island(island, steps);
}

void World::move_island(std::size_t island, std::uint64_t steps) {
    const auto bodies = physics_->island(island);
    const auto is_robot = [this](std::size_t body) { return body < robots_.size(); };
    const bool by_substep =
        std::ranges::any_of(bodies, [&](std::size_t i) { return is_robot(i) && may_reach_target(i, steps); });
    if (physics_->is_free(island) && !by_substep) {
        const std::size_t body = bodies.front();
        if (!is_robot(body)) return physics_->move_freely(island);
        const double turn = std::abs(robots_[body].command.turn) + speed_noise;
        if (steps > 1 && turn * static_cast<double>(steps) * description_.step < max_free_turn)
            return drive_freely(island, steps);
    }
    for (std::uint64_t done = 0; done < steps;) {
        const std::uint64_t stride = by_substep ? 1 : physics_->stride(island, steps - done);
        for (const std::size_t i : bodies) {
            if (!is_robot(i)) continue;
            drives_[i] = drive(i, substep_ + done, stride);
            if (!robots_[i].hinges.empty()) robots_[i].move_gripper(*physics_, description_.step, stride);
        }
        physics_->advance(island, drives_, stride);
        for (const std::size_t i : bodies)
            if (is_robot(i) && !resetting(i)) robots_[i].trials->follow(physics_->pose(i));
        done += stride;
    }
}

/// Whether a robot is so near to a target that every substep of its path counts.
bool World::may_reach_target(std::size_t bug, std::uint64_t steps) const {
    const double near_target = rules().reach + 0.55;  // 1 m
    const double near = near_target + (std::abs(robots_[bug].command.forward) + speed_noise) *
                                          static_cast<double>(steps) * description_.step;
    const Eigen::Vector2d at(physics_->pose(bug).x, physics_->pose(bug).y);
    return std::ranges::any_of(
        targets_, [&](const Eigen::Vector2d& target) { return (target - at).squaredNorm() < near * near; });
}

/// The mean velocity of a robot in `steps` substeps from number `substep` on, with noise.
Velocity World::drive(std::size_t bug, std::uint64_t substep, std::uint64_t steps) {
    const Robot& robot = robots_[bug];
    if (!driven_[bug]) return {};
    MotorCommand command = robot.command;
    if (steps == 1) {
        if (options_.noise) {
            std::array<double, 2> u{};
            robot.motor_noise.uniform(substep, u);
            command.forward += (2 * u[0] - 1) * speed_noise;
            command.turn += (2 * u[1] - 1) * speed_noise;
        }
        return physics_->velocity_of(bug, command);
    }
    const Pose2 &from = physics_->pose(bug),
                to = free_drive(from, command, steps, description_.step, options_.noise ? speed_noise : 0,
                                robot.motor_noise, first_stride_index + substep);
    const double seconds = static_cast<double>(steps) * description_.step;
    return {(to.x - from.x) / seconds, (to.y - from.y) / seconds, (to.yaw - from.yaw) / seconds};
}

/// Drives a robot that touches nothing through `steps` substeps at once.
void World::drive_freely(std::size_t island, std::uint64_t steps) {
    const std::size_t bug = physics_->island(island).front();
    Robot& robot = robots_[bug];
    if (!robot.hinges.empty()) robot.move_gripper(*physics_, description_.step, steps);
    const std::uint64_t index =
        substep_ == substeps_before(cycle_) ? first_free_index + cycle_ : first_stride_index + substep_;
    const Pose2 from = physics_->pose(bug);
    const Pose2 to = free_drive(from, robot.command, steps, description_.step,
                                options_.noise ? speed_noise : 0, robot.motor_noise, index);
    physics_->move_freely(island, to, physics_->velocity_of(bug, robot.command));
    robot.trials->follow(from, physics_->pose(bug));
}

/// Whether the world's rules end the trial of a robot.
bool World::is_over(std::size_t bug) const {
    if (!description_.trials) return false;
    const Trial trial = robots_[bug].trials->current(physics_->pose(bug), cycle_);
    return trial.reached_target ||
           static_cast<double>(trial.cycles) * seconds_per_cycle() >= rules().duration;
}

bool World::just_reached(std::size_t bug) const {
    const auto& all = robots_[bug].trials->finished();
    return !all.empty() && all.back().reached_target && all.back().first_cycle + all.back().cycles == cycle_;
}

/// Applies the reset rule in one substep. Returns true when the robot is not driven.
bool World::update_reset(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (!robot.reset) return false;
    switch (robot.reset->substep(physics_->pose(bug), is_over(bug))) {
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

void World::begin_trial(std::size_t bug, const std::optional<Pose2>& start) {
    Robot& robot = robots_[bug];
    const Trial running = current_trial(bug);
    const Pose2 first =
        robot.trials->finished().empty() ? running.start : robot.trials->finished().front().start;
    if (running.first_cycle < cycle_) robot.trials->finish(physics_->pose(bug), cycle_);
    if (robot.reset) robot.reset->stop();
    const Pose2 pose = start ? *start : robot.reset ? robot.reset->start_pose() : first;
    physics_->remove(bug);
    physics_->place(bug, pose);
    robot.trials->begin(physics_->pose(bug), cycle_);
    robot.command = {};
    update_body_poses();
}

bool World::move_robot(std::size_t bug, const Pose2& pose) { return !resetting(bug) && move_body(bug, pose); }

bool World::move_object(std::size_t object, const Pose2& pose) {
    return move_body(robots_.size() + object, pose);
}

bool World::move_body(std::size_t body, const Pose2& pose) {
    if (!physics_->present(body)) return false;
    const Pose2 before = physics_->pose(body);
    physics_->remove(body);
    const bool free = physics_->is_collision_free(body, pose);
    physics_->place(body, free ? pose : before);
    if (free) update_body_poses();
    return free;
}

std::optional<std::size_t> World::first_blocked(std::span<const std::pair<std::size_t, Pose2>> robots) {
    Archive before;
    before(*physics_);
    for (const auto& robot : robots) physics_->remove(robot.first);
    const auto blocked = std::ranges::find_if(robots, [this](const auto& robot) {
        const bool free = physics_->is_collision_free(robot.first, robot.second);
        physics_->place(robot.first, robot.second);
        return !free;
    });
    Archive{std::string_view(before.bytes())}(*physics_);
    return blocked == robots.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(std::distance(robots.begin(), blocked)));
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
    body_poses_.sort();
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
    archive(body_poses_, game_);
    // Things may have been added to the world or removed from it.
    if (body_poses_.bodies.size() != bodies_.size())
        throw ArchiveError("the checkpoint is of a world with other things");
    archive(*physics_);
    if (archive.loading()) body_poses_.sort(), visuals_placed_ = false;
    if (archive.loading() && description_.game) colour_resources();
}

}  // namespace forage::bug
