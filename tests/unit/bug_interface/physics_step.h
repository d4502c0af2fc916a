// The step of the physics in the tests of motion and simulation.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "bug_interface/motion/physics.h"

namespace forage::test {

inline constexpr double physics_step_s = 0.001;

/// Simulates one time step. `commands[i]` drives body i; those of movable objects are ignored.
inline void step(bug::Physics& physics, std::span<const bug::MotorCommand> commands) {
    std::vector<bug::Velocity> velocities;
    std::vector<bug::Reach> reach;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        velocities.push_back(physics.velocity_of(i, commands[i]));
        reach.push_back(
            {std::abs(commands[i].forward) * physics_step_s, std::abs(commands[i].turn) * physics_step_s, 0});
    }
    physics.begin(reach, 1);
    for (std::size_t i = 0; i < physics.islands(); ++i) physics.advance(i, velocities, 1);
}

}  // namespace forage::test
