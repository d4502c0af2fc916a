// Overwrites the activity of groups, right after their update.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/engine/simulation.h"

namespace forage::observe {

class Clamp {
  public:
    /// From `cycle` on the group's activity is `values`, one per cell, until other values of a later cycle
    /// replace them. Of values for one cycle the last ones count.
    void add(std::int64_t cycle, int group, std::vector<double> values);

    /// There is nothing to apply, and will not be.
    bool idle() const { return waiting_.empty() && held_.empty(); }
    /// Between update_groups() and update_modules() of each cycle.
    void apply(engine::Simulation& simulation);
    /// Demands the groups that it overwrites.
    void declare(engine::Demand& out) const;

  private:
    struct Entry {
        int group;
        std::vector<double> values;
    };
    std::multimap<std::int64_t, Entry> waiting_;
    std::vector<Entry> held_;
};

}  // namespace forage::observe
