// Names in a map of a world, and what its lines mean.
#pragma once

#include "tools/plot/world_map.h"

namespace forage::plot {

/// "home A" and "home B" where robots are least in the way of reading it: outwards from their middles.
void draw_home_names(Canvas& canvas, const bug::World& world, const WorldMap& map);
/// The names of the robots beside them, within the map, none on another one or on a robot where that can be.
void draw_robot_names(Canvas& canvas, const bug::World& world, const WorldMap& map);

/// What the lines of the world's map mean, those only that it can have: from (left, y) to the right and on
/// to further lines before `right`. Returns the base line of the last one.
double draw_legend(Canvas& canvas, const bug::World& world, double left, double right, double y);

}  // namespace forage::plot
