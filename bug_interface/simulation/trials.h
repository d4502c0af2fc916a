// Follows a robot from reset to reset.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/run/trial.h"

namespace forage::bug {

/// One robot's trials.
class TrialLog {
  public:
    /// A robot (radius 0.2 m) whose centre comes nearer than this to the centre of a target (radius 0.25 m) has
    /// reached it, m.
    static constexpr double reach = 0.45;

    explicit TrialLog(std::vector<Eigen::Vector2d> targets) : targets_(std::move(targets)) {}

    /// `cycle`: the first one in which the robot is driven.
    void begin(const Pose2& start, std::uint64_t cycle);
    /// To be called after every substep of a trial.
    void follow(const Pose2& pose) {
        for (const Eigen::Vector2d& t : targets_) {
            const double dx = pose.x - t.x(), dy = pose.y - t.y();
            smallest_squared_ = std::min(smallest_squared_, dx * dx + dy * dy);
        }
    }
    /// In place of many substeps, of a way from one place to another that is nearly straight.
    void follow(const Pose2& from, const Pose2& to) {
        const Eigen::Vector2d start(from.x, from.y), way = Eigen::Vector2d(to.x, to.y) - start;
        for (const Eigen::Vector2d& t : targets_) {
            const double length = way.squaredNorm();
            const double part = length > 0 ? std::clamp((t - start).dot(way) / length, 0.0, 1.0) : 0;
            smallest_squared_ = std::min(smallest_squared_, (start + part * way - t).squaredNorm());
        }
    }
    /// `done`: how many cycles have begun since the start of the run.
    void finish(const Pose2& end, std::uint64_t done);

    const std::vector<Trial>& finished() const { return finished_; }
    /// The trial that runs now, after `done` cycles; while the robot is reset, the one to come.
    Trial current(const Pose2& pose, std::uint64_t done) const;
    void checkpoint(Archive& archive) { archive(finished_, current_, running_, smallest_squared_); }

  private:
    std::vector<Eigen::Vector2d> targets_;
    std::vector<Trial> finished_;
    Trial current_;
    bool running_ = false;
    double smallest_squared_ = std::numeric_limits<double>::infinity();
};

}  // namespace forage::bug
