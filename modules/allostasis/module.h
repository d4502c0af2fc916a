// moduleAllostasis: needs, drives and steering of one robot as a module.
#pragma once

#include "core/types/module.h"
#include "modules/allostasis/fields.h"
#include "modules/allostasis/steering.h"

namespace forage::allostasis {

/// Keeps five needs in balance (Guerrero-Rosado et al., "Enabling biomimetic self-regulation in intrinsically
/// motivated robots", ALIFE 2025). describe() lists its ports. Times are those of the world: a cycle takes
/// `cycle` s.
class AllostasisModule {
  public:
    double scale = 4, cycle = 0.04, interval = 0.12, extent_x = 10, extent_y = 10, noise = 50;
    double temperature_priority = 1, hydration_priority = 1, energy_priority = 1, security_priority = 1,
           mating_priority = 1;
    bool dead_sector = true, control = false;

    static void describe(ModuleSpec<AllostasisModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) {
        archive(drives_, steering_, wheels_, day_, views_, stepped_, last_step_);
    }

    const Drives& drives() const { return drives_; }

  private:
    Place place(const ConstColumn& gps) const;
    void act(ModuleFrame& frame, double time);

    Drives drives_;
    Steering steering_;
    WheelControl wheels_;
    Day day_;
    LocalViews views_ = LocalViews::Zero();
    bool stepped_ = false;  ///< whether needs and network have made a step
    double last_step_ = 0;  ///< time of their last step, s
    RandomStream random_;
    int motor_width_ = 0, motor_height_ = 0;
};

}  // namespace forage::allostasis
