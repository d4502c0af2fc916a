#include "core/observe/schedule.h"

namespace forage::observe {

void Schedule::check(const engine::Simulation& simulation, Diagnostics& diagnostics) const {
    std::vector<model::Assignment> changes;
    for (const auto& e : entries_) changes.push_back(e.change);
    simulation.check(changes, diagnostics);
}

void Schedule::before_cycle(RunView& run) {
    if (waiting_ == 0) return;
    for (auto& e : entries_)
        if (!e.cycle && e.when.holds(run.simulation, run.time)) {
            run.simulation.set(e.change);
            e.cycle = run.time.cycle;
            --waiting_;
        }
}

std::unique_ptr<Schedule> make_schedule(const std::vector<model::ScheduledChange>& changes,
                                        const model::System& system, const Registry& registry,
                                        const engine::Layout& layout, bool trials, Diagnostics& diagnostics) {
    auto out = std::make_unique<Schedule>();
    for (const auto& [when, what] : changes) {
        const std::string_view option = when.at.file ? "at" : "--schedule";
        auto condition = parse_condition(layout, trials, when.text, option, diagnostics, when.at);
        auto change = model::parse_assignment(system, registry, what.text, option, diagnostics, what.at);
        if (condition && change)
            out->add(std::move(*condition), std::move(*change), when.text + ": " + what.text);
    }
    return out;
}

}  // namespace forage::observe
