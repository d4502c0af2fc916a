#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"
#include "core/base/sequence.h"

namespace forage::bug {

std::vector<std::string> World::robot_names() const { return names_of(robots_); }

std::optional<std::size_t> World::find(std::string_view bug) const {
    for (std::size_t i = 0; i < robots_.size(); ++i)
        if (robots_[i].name == bug) return i;
    return {};
}

std::vector<DrawnSolid> World::drawing() const {
    auto out = drawing_of(description_);
    for (const MovingVisual& moving : moving_visuals_.all()) {
        if (moving.body < robots_.size() || !body_poses_.present[moving.body]) continue;
        Solid solid = moving.visual.solid;
        solid.pose = moving.at(body_poses_);
        out.push_back({solid, moving.visual.material.diffuse});
    }
    return out;
}

std::optional<Pose2> World::movable_object_pose(std::size_t i) const {
    const std::size_t body = robots_.size() + i;
    if (!body_poses_.present[body]) return {};
    return body_poses_.bodies[body];
}

Eigen::Vector2d World::looks_at(std::size_t bug) const {
    const Robot& robot = robots_[bug];
    const Eigen::Vector2d here(robot.pose.x, robot.pose.y);
    const auto& sensor = robot.sensors.camera_sensor();
    if (!sensor) return here;
    const Pose camera = robot.sensors.link_pose() * sensor->pose;
    const Eigen::Vector3d axis = camera.linear().col(0), at = camera.translation();
    if (axis.z() >= 0) return here;
    const Eigen::Vector3d floor = at - at.z() / axis.z() * axis;
    return here + Eigen::Rotation2Dd(robot.pose.yaw) * floor.head<2>();
}

std::vector<std::string> World::patch_colours() const {
    patches_ = &surroundings_->patches();
    return collected(*patches_, &Patch::colour);
}

std::optional<std::size_t> World::patch_in_view(std::size_t bug) const {
    const int patch = patches_ ? patch_at(*patches_, looks_at(bug)) : -1;
    if (patch < 0) return std::nullopt;
    return static_cast<std::size_t>(patch);
}

std::vector<Environment::Score> World::scores() const {
    std::vector<Score> out;
    for (int team = 0; team < 2 && !game_.empty(); ++team)
        out.push_back({Game::team_name(team), game_.points(team), game_.delivered(team, true),
                       game_.delivered(team, false)});
    return out;
}

std::optional<double> World::game_time_left() const {
    if (!game_.timed()) return std::nullopt;
    return game_.left();
}

std::string World::score_csv() const {
    std::string out = "seconds,team,resource,points,score_a,score_b\n";
    std::array<int, 2> score{};
    for (const auto& d : game_.deliveries()) {
        score[static_cast<std::size_t>(d.team)] += d.points;
        out += fmt::format("{:.3f},{},{},{},{},{}\n", d.time, Game::team_name(d.team),
                           d.good ? "good" : "bad", d.points, score[0], score[1]);
    }
    return out;
}

double World::target_distance(std::size_t bug) const {
    const Eigen::Vector2d at(robots_[bug].pose.x, robots_[bug].pose.y);
    double out = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& target : targets_) out = std::min(out, (target - at).norm());
    return out;
}

Trial World::current_trial(std::size_t bug) const {
    return robots_[bug].trials->current(robots_[bug].pose, cycle_);
}

}  // namespace forage::bug
