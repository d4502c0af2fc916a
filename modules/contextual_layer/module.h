// moduleCL: the contextual layer as a module.
#pragma once

#include <array>

#include "core/types/module.h"
#include "modules/contextual_layer/contextual_layer.h"

namespace forage::contextual {

/// Inputs: `action` (M cells), `prototype` (N cells), `stats` (positive goal, negative goal) and
/// `discrepancy` (its first cell). Outputs: `action` (at most M cells) and, optionally, pictures of the
/// long-term memory. Nothing is written while the layer is closed. `Memory Height` and `Memory Width` are
/// read at the start, the other parameters in each update.
class ContextualLayerModule {
  public:
    double height = 1, width = 1;
    double threshold = 0, share = 0, reset = 0, decay = 0, discrepancy = 0;

    static void describe(ModuleSpec<ContextualLayerModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) {
        archive(layer_, displayed_, shown_[0], shown_[1], shown_[2], shown_[3]);
    }

    const ContextualLayer& layer() const { return layer_; }

  private:
    ContextualLayer layer_;
    bool displayed_ = false;  ///< whether the pictures have been written once
    std::array<SegmentArray, 4>
        shown_;  ///< the content of the pictures collector, distance, selected, trigger
};

}  // namespace forage::contextual
