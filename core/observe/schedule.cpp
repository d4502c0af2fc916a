#include "core/observe/schedule.h"

namespace forage::observe {

void Schedule::apply(engine::Simulation& simulation, const SimTime& now) {
    for (auto& e : entries_)
        if (!e.cycle && e.when.holds(simulation, now)) {
            simulation.set(e.change);
            e.cycle = now.cycle;
            --waiting_;
        }
}

}  // namespace forage::observe
