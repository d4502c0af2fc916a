// Occupancy plot: where robots were, over many trials.
#pragma once

#include <string>
#include <vector>

#include "tools/plot/trajectory.h"

namespace forage::plot {

/// A map of the world in which the colour of a cell is the share of the paths that crossed it. White lines
/// are the mean paths from each start pose: the mean places after the same share of each path's length. The
/// world must outlive the picture.
Picture occupancy_plot(const bug::World& world, const std::vector<Path>& paths, const std::string& title);

}  // namespace forage::plot
