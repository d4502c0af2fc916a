#include "core/run/run_measures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/constants.h"
#include "core/run/environment.h"

namespace forage {
namespace {

using Kind = model::Measure::Kind;

bool is_of_trials(Kind kind) {
    return kind == Kind::success || kind == Kind::duration || kind == Kind::distance;
}

bool counts(Kind kind) { return kind == Kind::trials || kind == Kind::cycles || kind == Kind::share; }

bool is_over_cycles(Kind kind) {
    return kind == Kind::mean || kind == Kind::minimum || kind == Kind::maximum;
}

/// A mean over the last `last` finished trials of the first robot; empty when there are none.
std::optional<double> mean_of_trials(const model::Measure& m, const Environment& environment) {
    const std::span all(environment.trials(0));
    const auto trials = m.last && *m.last < all.size() ? all.last(*m.last) : all;
    if (trials.empty()) return std::nullopt;
    double sum = 0;
    for (const auto& t : trials)
        sum += m.kind == Kind::success    ? (t.reached_target ? 1.0 : 0.0)
               : m.kind == Kind::distance ? t.smallest_distance
                                          : static_cast<double>(t.cycles) * environment.seconds_per_cycle();
    return sum / static_cast<double>(trials.size());
}

}  // namespace

RunMeasures::RunMeasures(std::span<const model::Measure> measures, const engine::Layout& layout,
                         Environment* environment, Diagnostics& diagnostics) {
    const bool trials = environment && environment->has_trials(0);
    for (const auto& m : measures) {
        Entry e{m, {}, {}, {}, {}, {}};
        if (m.kind == Kind::first || counts(m.kind)) {
            e.condition =
                observe::parse_condition(layout, trials, m.what.text, "measure", diagnostics, m.what.at);
            ++waiting_;
        } else if (m.kind == Kind::robot) {
            e.robot = RobotMeasure::make(m, environment, diagnostics);
        } else if (m.kind == Kind::formula) {
            read_formula(e, diagnostics);
        } else if (m.kind == Kind::final || is_over_cycles(m.kind)) {
            e.quantity =
                observe::parse_quantity(layout, trials, m.what.text, "measure", diagnostics, m.what.at);
        }
        if (!trials && (is_of_trials(m.kind) || m.kind == Kind::trials))
            diagnostics.error(m.at, fmt::format("measure '{}': this experiment has no trials", m.name),
                              "trials are those of a robot that its world puts back to the start");
        else if (m.kind == Kind::distance && !environment->has_targets())
            diagnostics.error(m.at, fmt::format("measure '{}': this world has no target", m.name),
                              "'forage world FILE' tells what is in a world");
        follows_ = follows_ || m.kind == Kind::robot || is_over_cycles(m.kind);
        entries_.push_back(std::move(e));
    }
}

void RunMeasures::read_formula(Entry& entry, Diagnostics& diagnostics) const {
    const model::Expression& what = entry.spec.what;
    const auto report = [&](std::size_t at, const std::string& message, const std::string& hint) {
        diagnostics.error(model::inside(what.at, at),
                          fmt::format("measure '{}': {}", entry.spec.name, message), hint);
    };
    std::vector<std::string> usable;
    for (const auto& e : entries_)
        if (is_formula_name(e.spec.name)) usable.push_back(e.spec.name);
    try {
        entry.formula.emplace(what.text);
    } catch (const FormulaError& e) {
        return report(e.at, e.what(), e.hint);
    }
    for (const auto& node : entry.formula->nodes()) {
        if (node.op != Formula::Op::name) continue;
        const std::string& name = entry.formula->name(node);
        if (contains(usable, name)) continue;
        const auto meant = nearest(name, usable);
        report(node.at, fmt::format("there is no measure '{}' above it", name),
               !meant.empty()   ? fmt::format("did you mean '{}'?", meant)
               : usable.empty() ? "a formula uses measures above it, whose names are letters, digits and _"
                                : fmt::format("above it are '{}'", separated(usable, "', '")));
    }
}

std::vector<model::Measure> RunMeasures::specs() const { return collected(entries_, &Entry::spec); }

void RunMeasures::declare(engine::Demand& demand) const {
    for (const auto& e : entries_) {
        if (e.condition) e.condition->declare(demand);
        if (e.quantity) e.quantity->declare(demand);
    }
}

void RunMeasures::check(const engine::Simulation& simulation, Diagnostics& diagnostics) const {
    const SimTime start{0, 0, 1};
    for (const auto& e : entries_)
        if (e.spec.kind == Kind::first && e.condition && e.condition->sees_cells() &&
            e.condition->holds(simulation, start))
            diagnostics.warning(e.spec.what.at,
                                fmt::format("measure '{}' holds before the first cycle, when all cells are 0",
                                            e.spec.what.text),
                                "add a time from which it counts, for example 'cycle > 100 and ...'");
}

void RunMeasures::before_cycle(RunView& run) {
    if (waiting_ == 0) return;
    const bool resetting = run.environment && run.environment->resetting(0);
    for (auto& e : entries_) {
        const bool counted = counts(e.spec.kind);
        // A share is one of cycles, after each of which the condition is checked.
        if (e.spec.kind == Kind::share && (resetting || run.time.cycle == 0)) continue;
        if (e.spec.kind == Kind::share) ++e.checked;
        if (!e.condition || (counted ? resetting : e.first.has_value()) ||
            !e.condition->holds(run.simulation, run.time))
            continue;
        if (!counted) {
            e.first = static_cast<double>(run.time.cycle);
            --waiting_;
            continue;
        }
        ++e.cycles;
        if (e.last_trial != run.time.trial) ++e.trials;
        e.last_trial = run.time.trial;
    }
}

void RunMeasures::after_cycle(RunView& run) {
    if (!follows_) return;
    for (auto& e : entries_) {
        if (e.robot) e.robot->after_cycle(*run.environment);
        if (!is_over_cycles(e.spec.kind)) continue;
        const double now = e.quantity->in(run.simulation, run.time);
        ++e.values, e.sum += now;
        e.low = std::min(e.low, now), e.high = std::max(e.high, now);
    }
}

void RunMeasures::checkpoint(Archive& archive) {
    for (auto& e : entries_) {
        archive(e.first, e.cycles, e.checked, e.trials, e.last_trial, e.values, e.sum, e.low, e.high);
        if (e.robot) e.robot->checkpoint(archive);
    }
    archive(waiting_);
}

std::optional<double> RunMeasures::value(Entry& e, RunView& run,
                                         std::span<const std::optional<double>> known) const {
    switch (e.spec.kind) {
        case Kind::success:
        case Kind::duration:
        case Kind::distance:
            return mean_of_trials(e.spec, *run.environment);
        case Kind::trials: {
            const auto finished = static_cast<int>(run.environment->trials(0).size());
            const int held = e.trials - (e.last_trial > finished ? 1 : 0);
            return finished == 0 ? std::nullopt : std::optional(static_cast<double>(held) / finished);
        }
        case Kind::cycles:
            return static_cast<double>(e.cycles);
        case Kind::share:
            return static_cast<double>(e.cycles) / static_cast<double>(e.checked);
        case Kind::first:
            return e.first;
        case Kind::final:
            return e.quantity->in(run.simulation, run.time);
        case Kind::mean:
            return e.sum / static_cast<double>(e.values);  // NaN, which is no number, before the first cycle
        case Kind::minimum:
            return std::isfinite(e.sum) ? e.low : e.sum;
        case Kind::maximum:
            return std::isfinite(e.sum) ? e.high : e.sum;
        case Kind::robot:
            return e.robot->value(*run.environment);
        case Kind::formula:
            // A measure without a number is NaN here, so what needs it has none either.
            return e.formula->value([&](const std::string& name, std::size_t) {
                const auto used = std::ranges::find(
                    entries_, name, [](const Entry& other) -> const auto& { return other.spec.name; });
                return known[static_cast<std::size_t>(used - entries_.begin())].value_or(std::nan(""));
            });
    }
    return std::nullopt;
}

std::vector<std::optional<double>> RunMeasures::values(RunView& run) {
    before_cycle(run);  // a condition may hold after the last cycle
    std::vector<std::optional<double>> out;
    for (auto& e : entries_) {
        auto number = value(e, run, out);
        if (number && !std::isfinite(*number)) number.reset();
        out.push_back(number);
    }
    return out;
}

}  // namespace forage
