#include "core/run/path_recorder.h"

#include <cmath>

#include <fmt/format.h>

#include "core/run/environment.h"
#include "core/run/result_files.h"

namespace forage {

constexpr std::size_t max_points = 1'000'000;

PathRecorder::PathRecorder(const Environment& environment, std::size_t robot, std::string file)
    : robot_(robot), file_(std::move(file)) {
    add(0, environment.pose(robot), true);
}

void PathRecorder::add(std::uint64_t cycle, const Pose2& pose, bool always) {
    if (!current_.points.empty()) {
        const auto& last = current_.points.back().pose;
        if (!always && std::hypot(pose.x - last.x, pose.y - last.y) < spacing_) return;
    }
    current_.points.push_back({cycle, pose});
    if (++count_ > max_points) thin();
}

void PathRecorder::after_cycle(RunView& run) {
    const std::uint64_t cycle = run.time.cycle - 1;
    const Environment& environment = *run.environment;
    const auto& trials = environment.trials(robot_);
    while (finished_.size() < trials.size()) {
        const auto& trial = trials[finished_.size()];
        add(cycle, trial.end, true);
        current_.reached = trial.reached_target;
        current_.finished = true;
        current_.points.shrink_to_fit();  // saves memory in runs of many trials
        finished_.push_back(std::move(current_));
        current_ = {};
    }
    if (environment.resetting(robot_)) return;
    if (current_.points.empty()) add(cycle, environment.current_trial(robot_).start, true);
    add(cycle, environment.pose(robot_), false);
}

/// Removes every second point, except the first and last of a trial.
void PathRecorder::thin() {
    spacing_ *= 2;
    count_ = 0;
    const auto halve = [this](Path& path) {
        std::vector<Point> kept;
        for (std::size_t i = 0; i < path.points.size(); ++i)
            if (i % 2 == 0 || i + 1 == path.points.size()) kept.push_back(path.points[i]);
        path.points = std::move(kept);
        count_ += path.points.size();
    };
    for (auto& path : finished_) halve(path);
    halve(current_);
}

std::vector<PathRecorder::Path> PathRecorder::paths(const Environment& environment) const {
    auto out = finished_;
    if (!current_.points.empty() && !environment.resetting(robot_)) {
        out.push_back(current_);
        out.back().reached =
            environment.has_trials(robot_) && environment.current_trial(robot_).reached_target;
    }
    return out;
}

void PathRecorder::finish(RunView& run, ResultFiles& files) {
    files.write(file_, [&] {
        std::string out = "trial,cycle,x,y,yaw\n";
        const auto add_trial = [&](std::size_t number, const Path& path) {
            for (const auto& p : path.points)
                out += fmt::format("{},{},{},{},{}\n", number, p.cycle, p.pose.x, p.pose.y, p.pose.yaw);
        };
        for (std::size_t i = 0; i < finished_.size(); ++i) add_trial(i + 1, finished_[i]);
        if (!run.environment->resetting(robot_)) add_trial(finished_.size() + 1, current_);
        return out;
    });
}

}  // namespace forage
