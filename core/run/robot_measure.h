// What a robot does in a run, as a number.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/archive.h"
#include "core/base/diagnostic.h"
#include "core/model/experiment.h"
#include "core/run/environment.h"

namespace forage {

/// Follows one of model::robot_quantities from the start of a run. In a world that resets the robot, the
/// number is the sum over its trials, or the smallest distance in all of them, with the unfinished one; what
/// happens during a reset does not count.
class RobotMeasure {
  public:
    /// The quantity of a measure of the kind `robot`. Empty when `diagnostics` got an error. `environment`
    /// may be null.
    static std::optional<RobotMeasure> make(const model::Measure& measure, Environment* environment,
                                            Diagnostics& diagnostics);

    /// Called after every cycle.
    void after_cycle(const Environment& environment);
    double value(const Environment& environment) const;
    void checkpoint(Archive& archive) { archive(length_, last_, finished_, there_, count_, nearest_); }

  private:
    // As robot_quantities.
    enum class What { path_length, displacement, collisions, target_visits, target_distance };
    RobotMeasure(What what, std::size_t robot, const Environment& environment);
    void follow_path(const Environment& environment);
    void count(const Environment& environment);

    What what_;
    std::size_t robot_;
    Pose2 start_;
    double length_ = 0;          ///< of the path, m
    std::optional<Pose2> last_;  ///< where the path has led; empty during a reset
    std::size_t finished_ = 0;   ///< number of trials whose path is complete
    bool there_ = false;  ///< whether the robot touched something, or was at a target, after the last cycle
    std::uint64_t count_ = 0;  ///< how often this began
    double nearest_;           ///< smallest distance to a target without regard to trials, m
};

}  // namespace forage
