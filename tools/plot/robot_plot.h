// A drawing of a robot: what the cells of its groups mean.
#pragma once

#include "bug_interface/simulation/world.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// A drawing of a robot of a world, which must outlive the picture: the rays with their cells, the motor
/// group, the heights of the sensors, and the floor that the camera sees. It is drawn from the numbers with
/// which the robot is simulated.
Picture robot_plot(const bug::World& world, std::size_t robot);

}  // namespace forage::plot
