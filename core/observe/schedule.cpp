#include "core/observe/schedule.h"

namespace forage::observe {

void Schedule::check(const engine::Simulation& simulation, Diagnostics& diagnostics) const {
    std::vector<model::Assignment> changes;
    for (const auto& e : entries_) changes.push_back(e.change);
    simulation.check(changes, diagnostics);
}

void Schedule::apply(engine::Simulation& simulation, const SimTime& now) {
    for (auto& e : entries_)
        if (!e.cycle && e.when.holds(simulation, now)) {
            simulation.set(e.change);
            e.cycle = now.cycle;
            --waiting_;
        }
}

}  // namespace forage::observe
