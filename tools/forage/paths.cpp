#include "tools/forage/paths.h"

#include <cmath>

#include <fmt/format.h>

namespace forage::tool {

constexpr std::size_t most_points = 1'000'000;

PathLog::PathLog(const bug::World& world, std::size_t robot) : world_(world), robot_(robot) {
    add(0, world.pose(robot), true);
}

void PathLog::add(std::uint64_t cycle, const Pose2& pose, bool always) {
    if (!current_.points.empty()) {
        const auto& last = current_.points.back().pose;
        if (!always && std::hypot(pose.x - last.x, pose.y - last.y) < spacing_) return;
    }
    current_.points.push_back({cycle, pose});
    if (++count_ > most_points) thin();
}

void PathLog::follow() {
    const std::uint64_t cycle = world_.cycle() - 1;
    const auto& trials = world_.trials(robot_);
    while (finished_.size() < trials.size()) {
        const auto& trial = trials[finished_.size()];
        add(cycle, trial.end, true);
        current_.reached = trial.reached_target;
        current_.finished = true;
        current_.points.shrink_to_fit();  // there may be many trials
        finished_.push_back(std::move(current_));
        current_ = {};
    }
    if (world_.resetting(robot_)) return;
    if (current_.points.empty()) add(cycle, world_.current_trial(robot_).start, true);
    add(cycle, world_.pose(robot_), false);
}

/// Leaves every second point out, the first and last of a trial excepted.
void PathLog::thin() {
    spacing_ *= 2;
    count_ = 0;
    const auto halve = [this](Trial& t) {
        std::vector<Point> kept;
        for (std::size_t i = 0; i < t.points.size(); ++i)
            if (i % 2 == 0 || i + 1 == t.points.size()) kept.push_back(t.points[i]);
        t.points = std::move(kept);
        count_ += t.points.size();
    };
    for (auto& t : finished_) halve(t);
    halve(current_);
}

plot::Path PathLog::drawn(const Trial& trial) {
    plot::Path out;
    for (const auto& p : trial.points) out.points.emplace_back(p.pose.x, p.pose.y);
    out.reached = trial.reached;
    out.finished = trial.finished;
    return out;
}

std::vector<plot::Path> PathLog::paths() const {
    std::vector<plot::Path> out;
    for (const auto& t : finished_) out.push_back(drawn(t));
    if (!current_.points.empty() && !world_.resetting(robot_)) {
        out.push_back(drawn(current_));
        out.back().reached = world_.current_trial(robot_).reached_target;
    }
    return out;
}

std::string PathLog::csv() const {
    std::string out = "trial,cycle,x,y,yaw\n";
    const auto add_trial = [&](std::size_t number, const Trial& t) {
        for (const auto& p : t.points)
            fmt::format_to(std::back_inserter(out), "{},{},{},{},{}\n", number, p.cycle, p.pose.x, p.pose.y,
                           p.pose.yaw);
    };
    for (std::size_t i = 0; i < finished_.size(); ++i) add_trial(i + 1, finished_[i]);
    if (!world_.resetting(robot_)) add_trial(finished_.size() + 1, current_);
    return out;
}

}  // namespace forage::tool
