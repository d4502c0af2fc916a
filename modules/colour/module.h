// moduleColor: the separation of a picture by hue.
#pragma once

#include "core/types/module.h"
#include "modules/colour/hue_bins.h"

namespace forage::colour {

/// Separates a picture by hue into one picture per bin of hues.
class ColourModule {
  public:
    static void describe(ModuleSpec<ColourModule>& s);
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(hue_, value_, computed_); }

  private:
    HueBins bins_;
    Eigen::ArrayXd hue_, value_;  ///< the inputs of the current output
    bool computed_ = false;
};

}  // namespace forage::colour
