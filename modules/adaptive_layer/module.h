// moduleAL: the adaptive layer between groups.
#pragma once

#include <string>

#include "core/types/module.h"
#include "modules/adaptive_layer/adaptive_layer.h"

namespace forage::adaptive {

/// Inputs `input` (CS, w x h) and `condition` (UR, K cells); outputs `prototype`, `output` (CR),
/// `descripancy` (its first cell) and, if wanted, `weight display`: K pictures of the CS side by side, the
/// k-th of the weights to CR cell k. With `read` or `write` set, the file is read or written at the end of
/// the next update, and the flag drops.
class AdaptiveLayerModule {
  public:
    double eta = 0.1, zeta = 0, rho = 0, init = 0.1, disc_time = 0.001;
    std::string file_name;
    bool write = false, read = false;

    static void describe(ModuleSpec<AdaptiveLayerModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    /// Draws the initial weights from the module's own stream.
    void start(const ModulePorts& ports);
    /// Throws std::runtime_error when a file that was asked for cannot be read or written.
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(layer_, display_old_); }

    AdaptiveLayer& layer() { return layer_; }

  private:
    void show_weights(Column display) const;

    AdaptiveLayer layer_;
    Index width_ = 0;          ///< of the CS
    bool display_old_ = true;  ///< the display is not of the present weights
};

}  // namespace forage::adaptive
