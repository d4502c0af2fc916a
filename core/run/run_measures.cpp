#include "core/run/run_measures.h"

#include <cmath>

#include <fmt/format.h>

#include "core/run/environment.h"

namespace forage {
namespace {

using Kind = model::Measure::Kind;

/// A mean over the last `last` finished trials of the first robot; empty when there are none.
std::optional<double> mean_of_trials(const model::Measure& m, const Environment& environment) {
    const std::span all(environment.trials(0));
    const auto trials = m.last && *m.last < all.size() ? all.last(*m.last) : all;
    if (trials.empty()) return std::nullopt;
    double sum = 0;
    for (const auto& t : trials)
        sum += m.kind == Kind::success ? (t.reached_target ? 1.0 : 0.0)
                                       : static_cast<double>(t.cycles) * environment.seconds_per_cycle();
    return sum / static_cast<double>(trials.size());
}

}  // namespace

RunMeasures::RunMeasures(std::span<const model::Measure> measures, const engine::Layout& layout, bool trials,
                         Diagnostics& diagnostics) {
    for (const auto& m : measures) {
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

void RunMeasures::declare(engine::Demand& demand) const {
    for (const auto& e : entries_) {
        if (e.condition) e.condition->declare(demand);
        if (e.quantity) e.quantity->declare(demand);
    }
}

void RunMeasures::check(const engine::Simulation& simulation, Diagnostics& diagnostics) const {
    const SimTime start{0, 0, 1};
    for (const auto& e : entries_)
        if (e.condition && e.condition->sees_cells() && e.condition->holds(simulation, start))
            diagnostics.warning(e.spec.what.at,
                                fmt::format("measure '{}' holds before the first cycle, when all cells are 0",
                                            e.spec.what.text),
                                "add a time from which it counts, for example 'cycle > 100 and ...'");
}

void RunMeasures::before_cycle(RunView& run) {
    if (waiting_ == 0) return;
    for (auto& e : entries_)
        if (e.condition && !e.first && e.condition->holds(run.simulation, run.time)) {
            e.first = static_cast<double>(run.time.cycle);
            --waiting_;
        }
}

std::vector<std::optional<double>> RunMeasures::values(RunView& run) {
    before_cycle(run);  // a condition may hold after the last cycle
    std::vector<std::optional<double>> out;
    for (const auto& e : entries_) {
        std::optional<double> value = e.first;
        if (e.quantity) value = e.quantity->in(run.simulation, run.time);
        if (e.spec.kind == Kind::success || e.spec.kind == Kind::duration)
            value = mean_of_trials(e.spec, *run.environment);
        if (value && !std::isfinite(*value)) value.reset();
        out.push_back(value);
    }
    return out;
}

}  // namespace forage
