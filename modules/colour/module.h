// moduleColor: the separation of a picture by hue.
#pragma once

#include "core/types/module.h"
#include "modules/colour/hue_bins.h"

namespace forage::colour {

/// Inputs: `_hue` and `_value` (w x h cells). Output: `_color` (w x n h): n pictures from top to bottom, one
/// per bin of hues. A picture has the values of the pixels whose hue is in its bin, and 0 elsewhere.
class ColourModule {
  public:
    static void describe(ModuleSpec<ColourModule>& s) {
        s.name("moduleColor", "Color Module")
            .doc("Separates a picture by hue: one picture per colour, stacked.");
        s.input("_hue", "Hue");
        s.input("_value", "Value");
        s.output("_color", "Color");
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(hue_, value_, computed_); }

  private:
    HueBins bins_;
    Eigen::ArrayXd hue_, value_;  ///< the inputs of the current output
    bool computed_ = false;
};

}  // namespace forage::colour
