#include "tools/forage/run_measures.h"

#include <cmath>

#include <fmt/format.h>

#include "tools/forage/schedule.h"

namespace forage::tool {
namespace {

using Kind = model::Measure::Kind;

/// The last `last` of the finished trials of the first robot.
std::span<const Trial> trials_of(const model::Measure& m, const bug::World& world) {
    const std::span all(world.trials(0));
    return m.last && *m.last < all.size() ? all.last(*m.last) : all;
}

std::optional<double> mean_of_trials(const model::Measure& m, const bug::World& world) {
    const auto trials = trials_of(m, world);
    if (trials.empty()) return std::nullopt;
    double sum = 0;
    for (const auto& t : trials)
        sum += m.kind == Kind::success ? (t.reached_target ? 1.0 : 0.0)
                                       : static_cast<double>(t.cycles) * world.seconds_per_cycle();
    return sum / static_cast<double>(trials.size());
}

}  // namespace

RunMeasures::RunMeasures(std::span<const model::Measure> wishes, const Loaded& loaded,
                         const engine::Layout& layout, Diagnostics& diagnostics) {
    const bool trials = has_trials(loaded);
    for (const auto& m : wishes) {
        Entry e{m, std::nullopt, std::nullopt, std::nullopt};
        if (m.kind == Kind::first) {
            e.condition =
                observe::parse_condition(layout, trials, m.what.text, "measure", diagnostics, m.what.at);
            ++waiting_;
        } else if (m.kind == Kind::final) {
            e.quantity =
                observe::parse_quantity(layout, trials, m.what.text, "measure", diagnostics, m.what.at);
        } else if (!trials) {
            diagnostics.error(m.at, fmt::format("measure '{}': this experiment has no trials", m.name),
                              "trials are those of a robot that its world puts back to the start");
        }
        entries_.push_back(std::move(e));
    }
}

void RunMeasures::check(const engine::Simulation& simulation, Diagnostics& diagnostics) const {
    const observe::SimTime start{0, 0, 1};
    for (const auto& e : entries_)
        if (e.condition && e.condition->sees_cells() && e.condition->holds(simulation, start))
            diagnostics.warning(e.wish.what.at,
                                fmt::format("measure '{}' holds before the first cycle, when all cells are 0",
                                            e.wish.what.text),
                                "add a time from which it counts, for example 'cycle > 100 and ...'");
}

void RunMeasures::see(const engine::Simulation& simulation, const observe::SimTime& now) {
    for (auto& e : entries_)
        if (e.condition && !e.first && e.condition->holds(simulation, now)) {
            e.first = static_cast<double>(now.cycle);
            --waiting_;
        }
}

std::vector<std::optional<double>> RunMeasures::values(const Loaded& loaded,
                                                       const engine::Simulation& simulation,
                                                       const observe::SimTime& now) const {
    std::vector<std::optional<double>> out;
    for (const auto& e : entries_) {
        std::optional<double> value = e.first;
        if (e.quantity) value = e.quantity->in(simulation, now);
        if (e.wish.kind == Kind::success || e.wish.kind == Kind::duration)
            value = mean_of_trials(e.wish, *loaded.world);
        if (value && !std::isfinite(*value)) value.reset();
        out.push_back(value);
    }
    return out;
}

void RunMeasures::declare(engine::Demand& out) const {
    for (const auto& e : entries_) {
        if (e.condition) e.condition->declare(out);
        if (e.quantity) e.quantity->declare(out);
    }
}

}  // namespace forage::tool
