// The reset rule: a robot that leaves the bounds, or whose trial is over, is reset to a start pose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"
#include "core/base/random.h"

namespace forage::bug {

/// The start poses of robots, and the bounds that end a trial.
struct ResetPlan {
    std::vector<Pose2> starts;
    std::vector<std::string> names;  ///< names of the models that give `starts`
    Eigen::AlignedBox2d bounds;      ///< bounds of the centre of a robot, m
    double heading = 0.01;           ///< largest deviation of a start pose's heading, rad
};

/// The start poses are those of the models Reset_0 to Reset_9. The bounds are the bounding box of the last
/// collision of the last link of the model GroundPlane. Returns nothing when the world has no start pose, as
/// robots are never reset then.
///
/// It is an error when there are start poses but no bounds (a plane has none), and when a start pose is not
/// inside the bounds. When two models have one of these names, a warning is given and the first one is used.
std::optional<ResetPlan> find_reset(const WorldDescription& world, Diagnostics& diagnostics);

/// The reset of one robot. It begins when the centre of the robot is outside the bounds or the world's rules
/// end the trial, and lasts for that substep and 1000 more. The original draws a new pose in every substep of
/// a reset. Here a pose is drawn only when the robot is observed and at the end, which gives the same
/// distribution: a start pose, each equally likely, plus up to 0.01 m in x and y and up to 0.01 rad, or what
/// the world's rules say.
class Reset {
  public:
    Reset(ResetPlan plan, RandomStream random) : plan_(std::move(plan)), random_(random) {}

    enum class Phase {
        none,   ///< the robot is driven
        begin,  ///< the trial has just ended; the robot is not driven
        hold,   ///< the robot is not driven
        end     ///< the robot is placed at a start pose, and is driven from the next substep on
    };
    /// Called once per substep with the pose at its beginning, and whether the rules end the trial.
    Phase substep(const Pose2& pose, bool over = false);
    bool running() const { return left_ > 0; }
    /// Ends a running reset without a start pose.
    void stop() { left_ = 0; }
    /// Draws the pose at which the robot is observed during a reset.
    Pose2 reset_pose() { return draw(reset_poses_++); }
    /// Draws the start pose of the next trial. The n-th start of a seed does not depend on earlier trials.
    Pose2 start_pose() { return draw(first_start + starts_++); }

    const ResetPlan& plan() const { return plan_; }
    void checkpoint(Archive& archive) { archive(left_, reset_poses_, starts_); }

    static constexpr int substeps = 1001;  ///< duration of a reset

  private:
    Pose2 draw(std::uint64_t index) const;

    /// The first random index of start poses; reset poses have lower indices.
    static constexpr std::uint64_t first_start = std::uint64_t{1} << 63;
    ResetPlan plan_;
    RandomStream random_;
    int left_ = 0;                                ///< substeps
    std::uint64_t reset_poses_ = 0, starts_ = 0;  ///< number of poses drawn
};

}  // namespace forage::bug
