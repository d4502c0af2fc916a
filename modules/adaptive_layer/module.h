// moduleAL: the adaptive layer as a module.
#pragma once

#include <string>

#include "core/types/module.h"
#include "modules/adaptive_layer/adaptive_layer.h"

namespace forage::adaptive {

/// describe() says what its groups hold. When `read` or `write` is set, the file of the weights is read or
/// written at the end of the next update, and the flag is cleared.
class AdaptiveLayerModule {
  public:
    double eta = 0.1, zeta = 0, rho = 0, init = 0.1, disc_time = 0.001;
    std::string file_name;
    bool write = false, read = false;

    static void describe(ModuleSpec<AdaptiveLayerModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    /// Draws the initial weights from the module's own random stream.
    void start(const ModulePorts& ports);
    /// Throws std::runtime_error when a requested file cannot be read or written.
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(layer_, display_outdated_); }

    AdaptiveLayer& layer() { return layer_; }

  private:
    void show_weights(Column display) const;

    AdaptiveLayer layer_;
    Index width_ = 0;               ///< width of the CS group, cells
    bool display_outdated_ = true;  ///< whether the weights have changed since they were displayed
};

}  // namespace forage::adaptive
