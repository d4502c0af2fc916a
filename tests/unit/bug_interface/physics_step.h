// The step of the physics in the tests of motion and simulation.
#pragma once

namespace forage::test {

inline constexpr double physics_step_s = 0.001;

}  // namespace forage::test
