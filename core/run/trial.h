// One robot's trial: what happened between two resets.
#pragma once

#include <cstdint>
#include <limits>

#include "core/base/archive.h"

namespace forage {

/// The position of a robot on the floor (world frame, m) and its heading (rad, counter-clockwise from the x
/// axis).
struct Pose2 {
    double x = 0, y = 0, yaw = 0;
    void checkpoint(Archive& archive) { archive(x, y, yaw); }
};

/// The time from a start pose to the moment when the robot leaves the bounds.
struct Trial {
    int number = 1;  ///< counts from 1
    Pose2 start;
    Pose2 end;                      ///< the robot's current pose while the trial runs
    std::uint64_t first_cycle = 0;  ///< the first cycle in which the robot is driven
    std::uint64_t cycles = 0;       ///< up to and including the cycle in which the trial ends
    /// The smallest distance between the centres of the robot and of a target during the trial, m; infinite
    /// in a world without targets.
    double smallest_distance = std::numeric_limits<double>::infinity();
    bool reached_target = false;

    void checkpoint(Archive& archive) {
        archive(number, start, end, first_cycle, cycles, smallest_distance, reached_target);
    }
};

}  // namespace forage
