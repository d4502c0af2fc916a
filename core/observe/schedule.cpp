#include "core/observe/schedule.h"

#include "core/model/lookup.h"

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

std::optional<model::ScheduledChange> parse_scheduled_change(std::string_view text) {
    bool quoted = false;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        quoted ^= text[i] == '"';
        if (!quoted && text[i] == ':' && text[i + 1] == ' ')
            return model::ScheduledChange{{std::string(model::trim(text.substr(0, i)))},
                                          {std::string(model::trim(text.substr(i + 1)))}};
    }
    return std::nullopt;
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
