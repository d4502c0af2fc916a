// The decoding of the motor group into a velocity command for the robot.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "core/base/archive.h"

namespace forage::bug {

/// A velocity command. The robot has these speeds at once: there is no acceleration phase.
struct MotorCommand {
    double forward = 0;  ///< m/s, along the heading of the robot
    double turn = 0;     ///< rad/s, positive to the left (counter-clockwise)
    void checkpoint(Archive& archive) { archive(forward, turn); }
    friend bool operator==(const MotorCommand&, const MotorCommand&) = default;
};

/// In every physics step a random speed between plus and minus this is added to both speeds of a robot, m/s
/// and rad/s, also when it stands still.
inline constexpr double speed_noise = 0.005;

/// Decodes the command by winner-takes-all: the most active cell of a `width` x `height` group (row by row
/// from the top) is the command, whatever its activity. The middle cell means standing still, the top row
/// +`forward_speed` (m/s), the bottom row -`forward_speed`, the left column +`turn_speed` (rad/s), the right
/// column -`turn_speed`; cells between them mean proportional speeds.
///
/// Both speeds are 0 when no cell is above 0, when all cells are equal, and for groups that are less than 2
/// cells wide or high. The original keeps the highest activity in single precision. Therefore the first of
/// several equal highest cells wins when rounding to single precision does not decrease the value (1, 0.5,
/// 0.25, 0.1, 0.8), and the last one wins when it does (0.7, 0.9, 0.95). The original also swaps the width
/// and the height when it computes the offsets from the middle, which is correct only for square groups.
MotorCommand decode_motor(std::span<const double> activities, int width, int height, double forward_speed,
                          double turn_speed);

/// The number of the cell that wins, row by row from the top; empty when the command is to stand still
/// because no cell is above 0 or all cells are equal.
std::optional<std::size_t> motor_winner(std::span<const double> activities);

/// What a command means: "straight ahead", "ahead in a left turn", "turn left on the spot", "stand still",
/// ...
std::string in_words(const MotorCommand& command);

}  // namespace forage::bug
