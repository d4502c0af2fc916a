// Occupancy plot: where robots were, over many trials.
#pragma once

#include <string>
#include <vector>

#include "tools/plot/trajectory.h"

namespace forage::plot {

/// The paths of one condition.
struct PathsOf {
    std::string name;  ///< of the condition; empty if there is only one
    std::vector<Path> paths;
};
/// The largest number of maps in an occupancy plot.
inline constexpr std::size_t max_maps = 24;

/// A map of the world per condition, in which the colour of a cell is the share of the paths that crossed it.
/// All maps have the same scale. White lines are the mean paths from each start pose: the mean places after
/// the same share of each path's length. The world must outlive the picture.
Picture occupancy_plot(const bug::World& world, const std::vector<PathsOf>& conditions,
                       const std::string& title, const std::string& part);

}  // namespace forage::plot
