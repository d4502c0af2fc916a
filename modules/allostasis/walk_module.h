// moduleAllostaticWalk: the random walk of the mate and the predator.
#pragma once

#include "core/types/module.h"
#include "modules/allostasis/steering.h"

namespace forage::allostasis {

/// Walks at random and turns away from obstacles, as the mate and the predator of the arena do
/// (Guerrero-Rosado et al., ALIFE 2025).
class WalkModule {
  public:
    double scale = 4, lowest = 3, highest = 6, fastest_turn = 4;
    int interval = 8;

    static void describe(ModuleSpec<WalkModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(walk_); }

  private:
    RandomWalk walk_;
    RandomStream random_;
    int width_ = 0, height_ = 0;  ///< of the motor group
};

}  // namespace forage::allostasis
