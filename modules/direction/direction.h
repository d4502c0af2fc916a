// directionModule: the turn towards the goal, and its distance.
#pragma once

#include "core/types/module.h"
#include "modules/peak.h"

namespace forage::goal {

/// The Euclidean distance between two positions, in cells.
double distance(const GridPosition& from, const GridPosition& to);

/// The direction from one position to another in turns, 0..1: 1 (or 0) is towards column 0, 0.75 towards row
/// 0, 0.5 towards the last column and 0.25 towards the last row. NaN when the positions are equal.
double bearing(const GridPosition& from, const GridPosition& to);

/// The turn from `orientation` to `bearing` (both in turns), on a scale where 0.5 means straight ahead. It
/// differs from 0.5 by a step that depends on the angle between them: 0 below 0.05 turns, 0.1 below 0.1, 0.33
/// below 0.15, else 0.45. It is above 0.5 when the bearing is at most half a turn ahead of the orientation.
double turn(double bearing, double orientation);

/// Shows the turn towards the goal and its distance. All outputs are 0 when a position is unknown.
class DirectionModule {
  public:
    double sigma = 0.2;

    static void describe(ModuleSpec<DirectionModule>& s);
    void start(const ModulePorts& ports) { width_ = ports.inputs[0].shape.width; }
    void update(ModuleFrame& frame) const;
    void checkpoint(Archive&) {}  // it has no state

  private:
    Index width_ = 1;  ///< width of the location and the goal group, cells
};

}  // namespace forage::goal
