#include "core/run/robot_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace forage {
namespace {

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

std::optional<RobotMeasure> RobotMeasure::make(const model::Measure& m, Environment* environment,
                                               Diagnostics& diagnostics) {
    const auto names = environment ? environment->robot_names() : std::vector<std::string>();
    const auto fail = [&](const Location& at, const std::string& message, const std::string& hint) {
        diagnostics.error(at, fmt::format("measure '{}': {}", m.name, message), hint);
        return std::nullopt;
    };
    const auto& all = model::robot_quantities;
    const auto what = std::ranges::find(all, m.what.text) - all.begin();
    if (what == std::ssize(all))
        return fail(m.what.at, fmt::format("'{}' is no measure of a robot", m.what.text),
                    suggest(m.what.text, std::vector<std::string>(all.begin(), all.end())));
    if (names.empty()) return fail(m.what.at, "this experiment has no robot", "name a <world> that has one");
    const auto robot = m.of.empty() ? names.begin() : std::ranges::find(names, m.of.text);
    if (robot == names.end())
        return fail(m.of.at, fmt::format("the world has no robot '{}'", m.of.text),
                    suggest(m.of.text, names));
    const bool of_targets =
        static_cast<What>(what) == What::target_visits || static_cast<What>(what) == What::target_distance;
    if (of_targets && !environment->has_targets())
        return fail(m.what.at, "this world has no target", "'forage world FILE' tells what is in a world");
    if (static_cast<What>(what) == What::collisions) environment->note_touches();
    return RobotMeasure(static_cast<What>(what), static_cast<std::size_t>(robot - names.begin()),
                        *environment);
}

RobotMeasure::RobotMeasure(What what, std::size_t robot, const Environment& environment)
    : what_(what),
      robot_(robot),
      start_(environment.pose(robot)),
      last_(start_),
      there_(what == What::target_visits && environment.at_target(robot)),
      nearest_(environment.target_distance(robot)) {}

void RobotMeasure::after_cycle(const Environment& environment) {
    if (what_ == What::path_length)
        follow_path(environment);
    else if (what_ == What::collisions || what_ == What::target_visits)
        count(environment);
    else if (what_ == What::target_distance)
        nearest_ = std::min(nearest_, environment.target_distance(robot_));
}

void RobotMeasure::follow_path(const Environment& environment) {
    const auto& trials = environment.trials(robot_);
    for (; finished_ < trials.size(); ++finished_) {
        length_ += distance(last_.value_or(trials[finished_].start), trials[finished_].end);
        last_.reset();
    }
    if (environment.resetting(robot_)) return;
    const Pose2 now = environment.pose(robot_);
    length_ += distance(last_ ? *last_ : environment.current_trial(robot_).start, now);
    last_ = now;
}

void RobotMeasure::count(const Environment& environment) {
    const bool now =
        !environment.resetting(robot_) &&
        (what_ == What::collisions ? environment.touched(robot_) : environment.at_target(robot_));
    if (now && !there_) ++count_;
    there_ = now;
}

double RobotMeasure::value(const Environment& environment) const {
    if (what_ == What::path_length) return length_;
    const bool has_trials = environment.has_trials(robot_);
    if (what_ == What::collisions || (what_ == What::target_visits && !has_trials))
        return static_cast<double>(count_);
    if (!has_trials)
        return what_ == What::target_distance ? nearest_ : distance(start_, environment.pose(robot_));
    auto trials = environment.trials(robot_);
    if (!environment.resetting(robot_)) trials.push_back(environment.current_trial(robot_));
    if (what_ == What::target_distance) {
        double least = std::numeric_limits<double>::infinity();
        for (const Trial& t : trials) least = std::min(least, t.smallest_distance);
        return least;
    }
    double sum = 0;
    for (const Trial& t : trials)
        sum += what_ == What::target_visits ? (t.reached_target ? 1.0 : 0.0) : distance(t.start, t.end);
    return sum;
}

}  // namespace forage
