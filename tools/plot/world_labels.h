// The names and the legend in a map of a world.
#pragma once

#include "tools/plot/world_map.h"

namespace forage::plot {

/// Writes "home A" and "home B" beside the centres of the homes, on the outer side, where there are fewer
/// robots.
void draw_home_names(Canvas& canvas, const bug::World& world, const WorldMap& map);
/// Writes the names of the robots beside them, within the map. Overlaps with other names and robots are
/// avoided if possible.
void draw_robot_names(Canvas& canvas, const bug::World& world, const WorldMap& map);

/// Draws the legend of the map, for those lines that the world can have. It starts at (left, y) and has as
/// many rows as needed to end before `right`. Returns the base line of the last row.
double draw_legend(Canvas& canvas, const bug::World& world, double left, double right, double y);

}  // namespace forage::plot
