#include <algorithm>

#include "bug_interface/simulation/world.h"

namespace forage::bug {

/// Updates the sensors with rates of their own in the first substep in which they are due.
void World::sense_due() {
    const double now = static_cast<double>(substep_ + 1) * description_.step;
    if (std::ranges::none_of(robots_, [&](const Robot& r) { return r.sensors.due(now); })) return;
    update_body_poses();
    for (Robot& robot : robots_) robot.sensors.sense_due(now, body_poses_, visuals());
}

void World::scan() {
    if (!options_.sensor_rates || cycle_ == 0)
        for (Robot& robot : robots_) robot.sensors.scan(cycle_, body_poses_);
    exchange_messages();
}

/// Delivers the messages that were transmitted in the cycle that ends.
void World::exchange_messages() {
    if (std::ranges::none_of(robots_, [](const Robot& r) { return r.transceiver.transmitting; })) return;
    deliver(transceivers_, body_poses_.bodies, by_name_);
    for (Robot& robot : robots_) robot.sensors.receive(sum_received(robot.transceiver, by_name_));
}

void World::render() {
    if (!options_.sensor_rates)
        for (Robot& robot : robots_)
            if (robot.sensors.image_requested()) robot.sensors.render(cycle_, body_poses_, visuals());
    remember();
}

void World::remember() {
    for (Robot& robot : robots_) robot.sensors.remember(cycle_, options_.latency);
}

MovingVisuals& World::visuals() {
    if (!visuals_placed_) moving_visuals_.forget_places();
    visuals_placed_ = true;
    return moving_visuals_;
}

void World::make_camera(std::size_t bug) {
    RobotSensors& sensors = robots_[bug].sensors;
    if (const auto& sensor = sensors.camera_sensor())
        sensors.make_camera(surroundings_->camera(bug, *sensor, sensors.link_pose()));
}

std::span<const std::uint8_t> World::image(std::size_t bug) {
    make_camera(bug);
    RobotSensors& sensors = robots_[bug].sensors;
    if (sensors.image_requested() && !options_.sensor_rates) return sensors.snapshot().image;  // up to date
    return sensors.view(cycle_, body_poses_, visuals());
}

void World::request_image(std::size_t bug, bool requested) {
    robots_[bug].sensors.request_image(requested);
    make_camera(bug);
    if (requested) robots_[bug].sensors.render(cycle_, body_poses_, visuals());
    if (cycle_ == 0) remember();
}

void World::request_gripper_scan(std::size_t bug, bool requested) {
    robots_[bug].sensors.request_gripper_scan(requested);
    if (requested && cycle_ == 0) robots_[bug].sensors.scan(0, body_poses_);
    if (cycle_ == 0) remember();
}

}  // namespace forage::bug
