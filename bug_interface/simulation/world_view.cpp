#include "bug_interface/simulation/world.h"

namespace forage::bug {

std::vector<std::string> World::bug_names() const {
    std::vector<std::string> names;
    for (const Robot& robot : robots_) names.push_back(robot.name);
    return names;
}

std::optional<std::size_t> World::find(std::string_view bug) const {
    for (std::size_t i = 0; i < robots_.size(); ++i)
        if (robots_[i].name == bug) return i;
    return {};
}

std::vector<DrawnSolid> World::drawing() const {
    auto out = drawing_of(description_);
    for (const MovingSight& sight : sights_) {
        if (sight.body < robots_.size() || !stage_.present[sight.body]) continue;
        Solid solid = sight.visual.solid;
        solid.pose = sight.at(stage_);
        out.push_back({solid, sight.visual.material.diffuse});
    }
    return out;
}

std::optional<Pose2> World::thing_pose(std::size_t i) const {
    const std::size_t body = robots_.size() + i;
    if (!stage_.present[body]) return {};
    return stage_.bodies[body];
}

Eigen::Vector2d World::looks_at(std::size_t bug) const {
    const Robot& robot = robots_[bug];
    const Eigen::Vector2d here(robot.pose.x, robot.pose.y);
    if (!robot.camera_sensor) return here;
    const Pose camera = robot.link_pose * robot.camera_sensor->pose;
    const Eigen::Vector3d axis = camera.linear().col(0), at = camera.translation();
    if (axis.z() >= 0) return here;
    const Eigen::Vector3d floor = at - at.z() / axis.z() * axis;
    return here + Eigen::Rotation2Dd(robot.pose.yaw) * floor.head<2>();
}

Trial World::current_trial(std::size_t bug) const {
    return robots_[bug].trials->current(robots_[bug].pose, cycle_);
}

}  // namespace forage::bug
