#include "tools/forage/paths.h"

namespace forage::tool {

constexpr double spacing = 0.01;  // m

PathLog::PathLog(const bug::World& world, std::size_t robot) : world_(world), robot_(robot) { add(world.pose(robot)); }

void PathLog::add(const bug::Pose2& pose) {
    const Eigen::Vector2d point(pose.x, pose.y);
    if (current_.points.empty() || (current_.points.back() - point).norm() >= spacing) current_.points.push_back(point);
}

void PathLog::follow() {
    const auto& trials = world_.trials(robot_);
    for (; trials_ < trials.size(); ++trials_) {
        const auto& trial = trials[trials_];
        add(trial.end);
        current_.reached = trial.target();
        finished_.push_back(std::move(current_));
        current_ = {};
    }
    if (!world_.resetting(robot_)) {
        if (current_.points.empty()) add(world_.current_trial(robot_).start);
        add(world_.pose(robot_));
    }
}

std::vector<plot::Path> PathLog::paths() const {
    auto out = finished_;
    if (current_.points.size() > 1) {
        out.push_back(current_);
        out.back().finished = false;
        out.back().reached = world_.current_trial(robot_).target();
    }
    return out;
}

}  // namespace forage::tool
