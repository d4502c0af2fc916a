#include "core/observe/schedule.h"

namespace forage::observe {

void Schedule::add(Condition when, std::variant<model::Assignment, Action> change, std::string text) {
    entries_.push_back({std::move(when), std::move(change), std::move(text), std::nullopt});
    ++waiting_;
}

void Schedule::declare(engine::Demand& demand) const {
    for (const auto& e : entries_) e.when.declare(demand);
}

void Schedule::checkpoint(Archive& archive) {
    for (auto& e : entries_) archive.same(e.text, "a change"), archive(e.cycle);
    archive(waiting_);
}

void Schedule::check(const engine::Simulation& simulation, Diagnostics& diagnostics) const {
    simulation.check(assignments(), diagnostics);
}

std::vector<model::Assignment> Schedule::assignments() const {
    std::vector<model::Assignment> out;
    for (const auto& e : entries_)
        if (const auto* assignment = std::get_if<model::Assignment>(&e.change)) out.push_back(*assignment);
    return out;
}

void Schedule::before_cycle(RunView& run) {
    if (waiting_ == 0) return;
    for (auto& e : entries_)
        if (!e.cycle && e.when.holds(run.simulation, run.time)) {
            if (const auto* assignment = std::get_if<model::Assignment>(&e.change))
                run.simulation.set(*assignment);
            else
                std::get<Action>(e.change)(run);
            e.cycle = run.time.cycle;
            --waiting_;
        }
}

std::unique_ptr<Schedule> make_schedule(const std::vector<model::ScheduledChange>& changes,
                                        const model::System& system, const Registry& registry,
                                        const engine::Layout& layout, bool trials, Diagnostics& diagnostics,
                                        const ReadAction& read_action) {
    auto out = std::make_unique<Schedule>();
    for (const auto& [when, what] : changes) {
        const std::string_view option = when.at.file ? "at" : "--schedule";
        auto condition = parse_condition(layout, trials, when.text, option, diagnostics, when.at);
        std::optional<std::variant<model::Assignment, Schedule::Action>> change;
        Diagnostics unread;  // of a text that is another kind of change
        auto assignment =
            model::parse_assignment(system, registry, what.text, option, unread, what.at, what.value_at);
        auto action = assignment || !read_action ? std::nullopt : read_action(what, option, diagnostics);
        if (!assignment && !action)
            for (const auto& d : unread.all()) diagnostics.add(d);
        if (assignment)
            change = std::move(*assignment);
        else if (action && *action)
            change = std::move(*action);
        if (condition && change)
            out->add(std::move(*condition), std::move(*change), when.text + ": " + what.text);
    }
    return out;
}

}  // namespace forage::observe
