// The paths of a robot over the floor of its world, as a picture.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"

namespace forage::plot {

/// Where a robot drove in one trial.
struct Path {
    std::vector<Eigen::Vector2d> points;  ///< m
    bool reached = false;                 ///< the target
    bool finished = true;                 ///< false for the trial that ran when the run ended
};

/// Draws the floor from above with walls, start positions and targets, and the paths on it: coloured from
/// dark to light by trial, with a dot at the end of those that reached the target, a cross at the end of
/// those that missed it and a square where the robot was when the run ended. The same paths give the same
/// bytes. Throws std::runtime_error when the file cannot be written.
void draw_trajectory(const bug::World& world, const std::vector<Path>& paths, const std::string& title,
                     const std::string& png);

}  // namespace forage::plot
