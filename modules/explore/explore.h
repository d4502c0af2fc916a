// moduleExplore: a random walk of straight stretches and turns, as one of three actions.
#pragma once

#include "core/types/module.h"

namespace forage::explore {

/// The reactive layer of Freire et al. (arXiv:2112.14734): ahead for up to 20 decisions, then to one side for
/// up to 20, and so on.
class ExploreModule {
  public:
    int interval = 4, straight = 20, turn = 20;

    static void describe(ModuleSpec<ExploreModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(cycles_, decisions_, straight_, turn_, side_); }

  private:
    void draw(std::uint64_t cycle);

    RandomStream random_;
    std::int64_t cycles_ = 0;      ///< of this trial
    int decisions_ = 0;            ///< of this bout
    int straight_ = 0, turn_ = 0;  ///< decisions of this bout that go ahead, and that turn
    int side_ = 0;                 ///< 0: left, 1: right
};

}  // namespace forage::explore
