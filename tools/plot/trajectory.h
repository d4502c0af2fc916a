// The paths of a robot over the floor of its world, as a picture.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// Where a robot drove in one trial.
struct Path {
    std::vector<Eigen::Vector2d> points;  ///< m
    bool reached = false;                 ///< the target
    bool finished = true;                 ///< false for the trial that ran when the run ended
};

/// The floor from above with walls, start positions and targets, and the paths on it: in one colour those
/// that reached the target, in another those that missed it, darker the earlier the trial; with a dot, a
/// cross or, where the robot was when the run ended, a square at the end. The world must outlive the picture.
Picture trajectory_plot(const bug::World& world, std::vector<Path> paths, const std::string& title);

}  // namespace forage::plot
