// Trajectory plot: the paths of a robot in its world.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "tools/plot/canvas.h"
#include "tools/plot/plot_spec.h"

namespace forage::plot {

/// The path of a robot in one trial.
struct Path {
    std::vector<Eigen::Vector2d> points;  ///< m
    bool reached = false;                 ///< whether the robot reached a target
    bool finished = true;                 ///< false for a trial that was interrupted by the end of the run
    std::size_t trial = 1;                ///< the number of the trial
};

/// The paths of the trials that `spec` wants.
std::vector<Path> wanted_paths(std::vector<Path> paths, const PlotSpec& spec);
/// "the run had 4 trials", of a run with a path per trial.
std::string count_of_trials(std::size_t paths);

/// A map of the floor, walls, start poses and targets with the paths. Paths that reached a target and paths
/// that missed it have different colours, which are darker for earlier trials of those that are drawn. A path
/// ends with a dot (target reached), a cross (missed) or a square (the run ended). In a world with several
/// robots, the title begins with the name of the robot. The world must outlive the picture.
Picture trajectory_plot(const bug::World& world, std::vector<Path> paths, const std::string& title,
                        std::size_t robot = 0);

}  // namespace forage::plot
