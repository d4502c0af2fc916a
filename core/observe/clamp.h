// Overwrites the activity of groups, right after their update.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/observe/observer.h"

namespace forage::observe {

class Clamp final : public Observer {
  public:
    /// From `cycle` on the group's activity is `values`, one per cell, until other values of a later cycle
    /// replace them. Of values for one cycle the last ones count.
    void add(std::int64_t cycle, int group, std::vector<double> values);

    /// There is nothing to apply, and will not be.
    bool idle() const { return waiting_.empty() && held_.empty(); }
    void after_groups(RunView& run) override;
    void declare(engine::Demand& out) const override;

  private:
    struct Entry {
        int group;
        std::vector<double> values;
    };
    std::multimap<std::int64_t, Entry> waiting_;
    std::vector<Entry> held_;
};

}  // namespace forage::observe
