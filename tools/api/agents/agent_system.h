// Systems without a brain: a robot's module, with one group per sensor and motor.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/model/system.h"

namespace forage {

/// A group at a port of the robot's module. The port's name may lack its leading '_': "target", "motor".
struct AgentGroup {
    std::string port;
    int width = 0, height = 0;  ///< 0 for the size that the port requires, or a usual one
};

/// The body of a robot: what its agent senses and moves.
struct AgentBody {
    std::string robot;  ///< the robot's name in the world
    std::vector<AgentGroup> sensors, motors;
    double forward_speed = 1, turn_speed = 1.5;  ///< of full speed ahead, m/s, and a full turn, rad/s
};

/// A system with one process per body, named after its robot. Its groups have the names of the ports without
/// the '_', so that "Bug/target" senses the light and "Bug/motor" drives the robot Bug. Reports unknown
/// ports.
model::System agent_system(const std::vector<AgentBody>& bodies, Diagnostics& diagnostics);

/// Whether the numbers at a sensor's port are certain to be between 0 and 1.
bool in_unit_range(const std::string& port);

}  // namespace forage
