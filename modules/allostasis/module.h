// moduleAllostasis: needs, drives and steering of one robot as a module.
#pragma once

#include <deque>

#include "core/types/module.h"
#include "modules/allostasis/fields.h"
#include "modules/allostasis/steering.h"

namespace forage::allostasis {

/// Keeps five needs in balance (Guerrero-Rosado et al., "Enabling biomimetic self-regulation in intrinsically
/// motivated robots", ALIFE 2025). describe() lists its ports. Times are those of the world: a cycle takes
/// `cycle` s.
class AllostasisModule {
  public:
    double view_interval = 1, view_delay = 1;
    double scale = 4, cycle = 0.04, interval = 0.12, extent_x = 10, extent_y = 10, noise = 50;
    double temperature_priority = 1, hydration_priority = 1, energy_priority = 1, security_priority = 1,
           mating_priority = 1;
    bool dead_sector = true, field_offset = true, control = false;

    static void describe(ModuleSpec<AllostasisModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) {
        archive(drives_, steering_, wheels_, day_, views_, stepped_, last_step_, coming_, looked_,
                last_look_);
    }

    const Drives& drives() const { return drives_; }

  private:
    Place place(const ConstColumn& gps) const;
    bool look(ModuleFrame& frame, double time, int step);
    void act(ModuleFrame& frame, double time);

    Drives drives_;
    Steering steering_;
    WheelControl wheels_;
    Day day_;
    LocalViews views_ = LocalViews::Zero();
    struct View {
        double time = 0;  ///< when it was taken, s
        LocalViews views = LocalViews::Zero();
        void checkpoint(Archive& archive) { archive(time, views); }
    };
    std::deque<View> coming_;  ///< views that are not yet used
    bool looked_ = false;      ///< whether a view has been taken
    double last_look_ = 0;     ///< when the last one was, s
    bool stepped_ = false;     ///< whether needs and network have made a step
    double last_step_ = 0;     ///< time of their last step, s
    RandomStream random_;
    int motor_width_ = 0, motor_height_ = 0;
};

}  // namespace forage::allostasis
