#include <algorithm>

#include "bug_interface/simulation/world.h"

namespace forage::bug {

/// Sensors at their own rates look in the first substep in which their time has come.
void World::sense_when_due() {
    const double now = static_cast<double>(substep_ + 1) * description_.step;
    const auto due = [&](const Robot& robot) { return robot.due(now); };
    if (std::none_of(robots_.begin(), robots_.end(), due)) return;
    update_body_poses();
    for (Robot& robot : robots_) robot.sense_due(now, options_.noise, body_poses_, placed_visuals());
}

void World::scan() {
    if (!options_.sensor_rates || cycle_ == 0)
        for (Robot& robot : robots_) robot.sense(options_.noise, cycle_, body_poses_);
    exchange_messages();
}

/// Messages that were transmitted in the cycle that ends are received now.
void World::exchange_messages() {
    bool sent = false;
    for (const Robot& robot : robots_) sent |= robot.transceiver.transmitting;
    if (!sent) return;
    deliver(transceivers_, body_poses_.bodies, by_name_);
    for (Robot& robot : robots_) robot.snapshot.received = sum_received(robot.transceiver, by_name_);
}

void World::render() {
    if (!options_.sensor_rates)
        for (Robot& robot : robots_)
            if (robot.wants_image) robot.render(options_.noise, cycle_, body_poses_, placed_visuals());
    remember();
}

void World::remember() {
    if (options_.latency <= 0) return;
    const auto size = static_cast<std::size_t>(options_.latency) + 1;
    for (Robot& robot : robots_) {
        if (cycle_ == 0)
            robot.history.assign(size, robot.snapshot);
        else
            robot.history[cycle_ % size] = robot.snapshot;
    }
}

const BugSnapshot& World::snapshot(std::size_t bug) const {
    const Robot& robot = robots_[bug];
    return robot.history.empty() ? robot.snapshot : robot.history[(cycle_ + 1) % robot.history.size()];
}

std::shared_ptr<const Scene> World::scene() const {
    if (!scene_) scene_ = std::make_shared<const Scene>(without_movers(description_));
    return scene_;
}

/// What cameras see of all that moves, at the body poses.
std::span<const MovingVisual> World::placed_visuals() {
    if (!visuals_placed_)
        for (MovingVisual& moving : moving_visuals_)
            if (body_poses_.present[moving.body]) moving.visual.solid.pose = moving.at(body_poses_);
    visuals_placed_ = true;
    return moving_visuals_;
}

void World::make_camera(std::size_t bug) {
    if (robots_[bug].camera_sensor && !robots_[bug].camera) robots_[bug].make_camera(scene());
}

std::span<const std::uint8_t> World::image(std::size_t bug) {
    make_camera(bug);
    Robot& robot = robots_[bug];
    if (robot.wants_image && !options_.sensor_rates) return robot.snapshot.image;  // step() renders it
    return robot.view(options_.noise, cycle_, body_poses_, placed_visuals());
}

void World::need_image(std::size_t bug, bool needed) {
    Robot& robot = robots_[bug];
    robot.wants_image = needed;
    make_camera(bug);
    if (needed) robot.render(options_.noise, cycle_, body_poses_, placed_visuals());
    if (cycle_ == 0) remember();
}

void World::need_gripper_scan(std::size_t bug, bool needed) {
    robots_[bug].wants_gripper_scan = needed;
    if (needed && cycle_ == 0) robots_[bug].sense(options_.noise, 0, body_poses_);
    if (cycle_ == 0) remember();
}

}  // namespace forage::bug
