// directionModule: which way to turn towards the goal, and how far it is.
#pragma once

#include "core/types/module.h"
#include "modules/peak.h"

namespace forage::goal {

/// Distance in cells between two places.
double distance(const Place& from, const Place& to);

/// Direction from one place to another as a part of a turn, 0..1: rows grow downwards, so 1 (or 0) is towards
/// column 0, 0.75 towards row 0, 0.5 towards the last column, 0.25 towards the last row. NaN when the places
/// are the same.
double bearing(const Place& from, const Place& to);

/// The turn that takes `orientation` to `bearing`, both parts of a turn: 0.5 goes straight on, 0.05 .. 0.95
/// in steps by how far they are apart (none below 0.05 of a turn, then 0.1, 0.33, 0.45), above 0.5 when the
/// bearing is ahead by half a turn at most.
double turn(double bearing, double orientation);

/// Inputs `_location`, `_goal` (same size) and `_ori` (n cells, a whole turn from first to last); outputs
/// `_dir` (m cells; 1 at cell (1 - turn) m, all 0 when a place is not known) and `_dist` (in cells, 0 when
/// not known).
class DirectionModule {
  public:
    double sigma = 0.2;

    static void describe(ModuleSpec<DirectionModule>& s) {
        s.name("directionModule", "Goal direction")
            .doc("Shows which way to turn towards the goal, and how far it is.");
        s.param("_sigma", &DirectionModule::sigma).label("Sigma").doc("No effect, as in the original.");
        s.input("_location", "Current location");
        s.input("_ori", "Current orientation");
        s.input("_goal", "Goal location");
        s.output("_dir", "Goal direction");
        s.output("_dist", "Goal distance");
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports) { width_ = ports.inputs[0].shape.width; }
    void update(ModuleFrame& frame) const;
    void checkpoint(Archive&) {}  // all is known from the start

  private:
    Index width_ = 1;  ///< of location and goal
};

}  // namespace forage::goal
