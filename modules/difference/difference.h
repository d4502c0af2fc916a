// differenceModule: where the goal is, seen from here.
#pragma once

#include <optional>

#include "core/types/module.h"
#include "modules/peak.h"

namespace forage::goal {

/// Writes 0 everywhere and, if both places are known, 1 at row (goal row - location row + H - 1), column
/// (goal column
/// - location column + W - 1) of `out`, which has (2 W - 1) x (2 H - 1) cells for groups of W x H.
void show_difference(const std::optional<Place>& location, const std::optional<Place>& goal, Index width,
                     Index height, Eigen::Ref<Eigen::ArrayXd> out);

/// Inputs `_location` and `_goal` (W x H); output `_diff` ((2 W - 1) x (2 H - 1)), whose centre means "here".
class DifferenceModule {
  public:
    static void describe(ModuleSpec<DifferenceModule>& s) {
        s.name("differenceModule", "Difference")
            .doc("Shows the place of the goal relative to the present location.");
        s.input("_location", "Current location");
        s.input("_goal", "Goal location");
        s.output("_diff", "Difference");
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports) { size_ = ports.inputs[0].shape; }
    void update(ModuleFrame& frame) {
        show_difference(place_of(frame.input(0), size_.width), place_of(frame.input(1), size_.width),
                        size_.width, size_.height, frame.output(0));
    }
    void checkpoint(Archive&) {}  // all is known from the start

  private:
    GroupShape size_;  ///< of location and goal
};

}  // namespace forage::goal
