// The data sheet of a robot: what its motors and sensors do, in numbers.
#pragma once

#include <string>

#include "bug_interface/simulation/world.h"

namespace forage::bug {

/// The data sheet of a robot of a world, in Markdown: body, motor cells, range sensors with the angle of
/// every cell, camera, gripper. All numbers are those with which the robot is simulated.
std::string data_sheet(const World& world, std::size_t robot);

}  // namespace forage::bug
