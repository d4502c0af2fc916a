// The reset rule: a robot that leaves the bounds is put back to a start pose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"
#include "core/base/random.h"

namespace forage::bug {

/// Where robots start, and the bounds that end a trial.
struct ResetPlan {
    std::vector<Pose2> starts;
    std::vector<std::string> names;  ///< of the models that give `starts`
    Eigen::AlignedBox2d bounds;      ///< of a robot's middle, m
};

/// The plan of a world: start poses are those of the models named Reset_0 to Reset_9, bounds those of the
/// last collision of the last link of the model named GroundPlane. Empty when there is no Reset_i: nothing is
/// ever reset. An error when there is one but no bounds (a plane has none: trials would never end), or one
/// that lies outside: robots would be put back for ever. Of two models with one of these names the first
/// counts, with a warning.
std::optional<ResetPlan> find_reset(const WorldDescription& world, Diagnostics& diagnostics);

/// One robot's reset: triggered when its middle is outside the bounds, it lasts that substep and 1000 more.
/// During these the original draws a new pose in every substep; here one is drawn for each look at the robot
/// and one for the end, which gives the same statistics. A draw: a start pose, each as likely, and up to 0.01
/// m and 0.01 rad off.
class Reset {
  public:
    Reset(ResetPlan plan, RandomStream random) : plan_(std::move(plan)), random_(random) {}

    /// What becomes of the robot in a substep.
    enum class Phase {
        none,   ///< it is driven
        begin,  ///< it has just left the bounds; it is not driven
        hold,   ///< it is not driven
        end     ///< it is placed at a drawn pose, and driven from the next substep on
    };
    /// To be called once per substep, with the pose at its start.
    Phase substep(const Pose2& pose);
    bool running() const { return left_ > 0; }
    /// Where the robot shows up when it is looked at during a reset.
    Pose2 reset_pose() { return draw(reset_poses_++); }
    /// Where the next trial starts: the n-th start of a seed is the same whatever happened in the trials
    /// before.
    Pose2 start() { return draw(first_start + starts_++); }

    const ResetPlan& plan() const { return plan_; }
    void checkpoint(Archive& archive) { archive(left_, reset_poses_, starts_); }

    static constexpr int substeps = 1001;  ///< that a reset takes

  private:
    ResetPlan plan_;
    RandomStream random_;
    int left_ = 0;
    static constexpr std::uint64_t first_start = std::uint64_t{1} << 63;  // apart from the glimpses
    Pose2 draw(std::uint64_t index) const;
    std::uint64_t reset_poses_ = 0, starts_ = 0;
};

}  // namespace forage::bug
