// differenceModule: the position of the goal relative to the current location.
#pragma once

#include <optional>

#include "core/types/module.h"
#include "modules/peak.h"

namespace forage::goal {

/// Sets one cell of `out` to 1 and all others to 0. For groups of W x H cells, `out` has (2 W - 1) x (2 H -
/// 1) cells, and the cell is in row (goal row - location row + H - 1) and column (goal column - location
/// column + W - 1). All cells are 0 when a position is unknown.
void show_difference(const std::optional<GridPosition>& location, const std::optional<GridPosition>& goal,
                     Index width, Index height, Eigen::Ref<Eigen::ArrayXd> out);

/// Shows where the goal is, seen from the current location.
class DifferenceModule {
  public:
    static void describe(ModuleSpec<DifferenceModule>& s) {
        s.name("differenceModule", "Difference")
            .doc("Shows the position of the goal relative to the current location.");
        s.input("_location", "Current location")
            .full_rectangle()
            .doc("The most active cell is the current location.");
        s.input("_goal", "Goal location").same_size_as("_location").doc("The most active cell is the goal.");
        s.output("_diff", "Difference")
            .size("twice the width and height of '_location' less one",
                  [](const auto&, PortSizes& of, const GroupShape&) {
                      const auto location = of["_location"];
                      return rectangle(2 * location.width - 1, 2 * location.height - 1);
                  })
            .doc("1 at the goal, 0 elsewhere; the middle stands for the current location.");
    }
    void start(const ModulePorts& ports) { size_ = ports.inputs[0].shape; }
    void update(ModuleFrame& frame) {
        show_difference(peak_position(frame.input(0), size_.width),
                        peak_position(frame.input(1), size_.width), size_.width, size_.height,
                        frame.output(0));
    }
    void checkpoint(Archive&) {}  // it has no state

  private:
    GroupShape size_;  ///< size of the location and the goal group
};

}  // namespace forage::goal
