// Records the trials of a robot, from reset to reset.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "bug_interface/world/description.h"
#include "core/run/trial.h"

namespace forage::bug {

/// Records the trials of one robot.
class TrialLog {
  public:
    /// `targets` are the centres of the targets, m. One is reached when the robot's centre is nearer than
    /// `reach`, m.
    explicit TrialLog(std::vector<Eigen::Vector2d> targets, double reach = TrialRules().reach)
        : targets_(std::move(targets)), reach_(reach) {}

    /// Begins a trial. `cycle` is the first cycle in which the robot is driven.
    void begin(const Pose2& start, std::uint64_t cycle);
    /// Updates the smallest distance; called after every substep of a trial.
    void follow(const Pose2& pose) {
        for (const Eigen::Vector2d& t : targets_) {
            const double dx = pose.x - t.x(), dy = pose.y - t.y();
            smallest_squared_ = std::min(smallest_squared_, dx * dx + dy * dy);
        }
    }
    /// Updates the smallest distance for a path that is nearly straight; replaces the calls of many substeps.
    void follow(const Pose2& from, const Pose2& to) {
        const Eigen::Vector2d start(from.x, from.y), path = Eigen::Vector2d(to.x, to.y) - start;
        for (const Eigen::Vector2d& t : targets_) {
            const double length = path.squaredNorm();
            const double fraction = length > 0 ? std::clamp((t - start).dot(path) / length, 0.0, 1.0) : 0;
            smallest_squared_ = std::min(smallest_squared_, (start + fraction * path - t).squaredNorm());
        }
    }
    /// Ends the trial. `done` is the number of cycles that have begun since the start of the run.
    void finish(const Pose2& end, std::uint64_t done);

    const std::vector<Trial>& finished() const { return finished_; }
    /// The unfinished trial after `done` cycles. During a reset it is the next one, which has not begun.
    Trial current(const Pose2& pose, std::uint64_t done) const;
    void checkpoint(Archive& archive) { archive(finished_, current_, running_, smallest_squared_); }

  private:
    std::vector<Eigen::Vector2d> targets_;
    double reach_;  ///< m
    std::vector<Trial> finished_;
    Trial current_;
    bool running_ = false;
    double smallest_squared_ = std::numeric_limits<double>::infinity();  ///< m^2
};

}  // namespace forage::bug
