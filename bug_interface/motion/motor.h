// What the motor group tells the robot to do.
#pragma once

#include <span>

#include "core/base/archive.h"

namespace forage::bug {

/// Speeds that a robot is driven with. They hold at once: there is no inertia to overcome.
struct MotorCommand {
    double forward = 0;  ///< m/s, along the robot's heading
    double turn = 0;     ///< rad/s, counter-clockwise: to the left
    void checkpoint(Archive& archive) { archive(forward, turn); }
    friend bool operator==(const MotorCommand&, const MotorCommand&) = default;
};

/// Winner takes all: the cell of the `width` x `height` group with the highest of `activities` is the
/// command. The middle cell stands still, the top row drives at +`forward_speed` (m/s), the bottom row at
/// -`forward_speed`, the left column turns at +`turn_speed` (rad/s), the right column at -`turn_speed`. How
/// high the activity is does not matter.
///
/// No command (both 0) when no cell is above 0 or all are equal, and for groups less than 2 cells wide or
/// high. Of several equal highest cells the first wins when the value, rounded to single precision, is not
/// below itself (1, 0.5, 0.25, 0.1, 0.8), and the last wins when rounding goes down (0.7, 0.9, 0.95): the
/// original keeps its extremes in single precision. It also takes the width for the height and the other way
/// round in the offsets, so that only square groups mean what they say.
MotorCommand decode_motor(std::span<const double> activities, int width, int height, double forward_speed,
                          double turn_speed);

}  // namespace forage::bug
