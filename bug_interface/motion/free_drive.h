// A control step of a robot that touches nothing, in closed form.
#pragma once

#include <cstdint>

#include "bug_interface/motion/motor.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// The largest turn in one call of free_drive(), rad.
inline constexpr double max_free_turn = 0.5;

/// The pose of a robot after `steps` substeps of `step` seconds. In each substep the robot moves with the
/// heading that it has at the start of the substep and with the speeds of `command`, to which independent
/// random numbers are added, uniform in -`noise`..`noise` (m/s and rad/s).
///
/// Without noise the result is the sum of the substeps in closed form. With noise, the sums of the noise
/// along the path, across it and in the heading are approximated by normal random numbers with the same
/// variances and covariance. Terms of second order are neglected; they are below 1e-8 m at 1 m/s.
///
/// |command.turn| * steps * step must not exceed max_free_turn. `index` is the position in the stream
/// `random`.
Pose2 free_drive(const Pose2& from, const MotorCommand& command, std::uint64_t steps, double step,
                 double noise, const RandomStream& random, std::uint64_t index);

}  // namespace forage::bug
