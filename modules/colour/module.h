// moduleColor: one picture per hue.
#pragma once

#include "core/types/module.h"
#include "modules/colour/hue_bins.h"

namespace forage::colour {

/// Inputs `_hue` and `_value` (w x h); output `_color` (w x n h): n pictures from top to bottom, each with
/// the values of the pixels whose hue is in that bin.
class ColourModule {
  public:
    static void describe(ModuleSpec<ColourModule>& s) {
        s.name("moduleColor", "Color Module")
            .doc("Takes a picture apart by hue: one picture per colour, stacked.");
        s.input("_hue", "Hue");
        s.input("_value", "Value");
        s.output("_color", "Color");
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(hue_, value_, shown_); }

  private:
    HueBins bins_;
    Eigen::ArrayXd hue_, value_;  ///< what the output shows
    bool shown_ = false;
};

}  // namespace forage::colour
