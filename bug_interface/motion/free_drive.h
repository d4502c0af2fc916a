// A control step of a robot that has nothing in its way, at once.
#pragma once

#include <cstdint>

#include "bug_interface/motion/motor.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// The longest turn that free_drive() may stand for, rad.
inline constexpr double longest_free_turn = 0.5;

/// Where a robot is after `steps` substeps of `step` seconds, in each of which it drives at the command's
/// speeds with its heading of the substep's start, and both speeds are off by independent numbers uniform in
/// -`noise`..`noise` (m/s, rad/s).
///
/// Without noise the sum of the substeps, in closed form. The noise enters to first order: its sums along the
/// path, across it and in the heading are normal numbers with the variances and the covariance that the
/// sums of so many uniform numbers have. What is left out, of second order, is below 10^-8 m at 1 m/s.
/// |command.turn| * steps * step must be at most longest_free_turn. `index` counts the draws of `random`.
Pose2 free_drive(const Pose2& from, const MotorCommand& command, std::uint64_t steps, double step,
                 double noise, const RandomStream& random, std::uint64_t index);

}  // namespace forage::bug
