#include "core/engine/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/engine/adopt.h"
#include "core/engine/cycle.h"
#include "core/engine/executor.h"
#include "core/engine/parameters.h"
#include "core/engine/plan/compile.h"
#include "core/model/constants.h"

namespace forage::engine {

struct Simulation::Parts {
    Parts(Compiled compiled, const Options& options)
        : plan(std::move(compiled.plan)),
          state(std::move(compiled.state)),
          cycle(*plan, *state, options.threads),
          executor(make_executor(*plan, cycle, options.threads, options.parallel_threshold_ns,
                                 options.min_task_ns)) {}
    std::shared_ptr<const Plan> plan;
    std::unique_ptr<State> state;
    Cycle cycle;
    std::unique_ptr<Executor> executor;  ///< null when one thread does all
    bool shared = false;                 ///< the running cycle
    bool running = false;                ///< a cycle: between update_groups() and update_connections()
    std::uint64_t shared_cycles = 0;
    std::optional<NotFinite> not_finite;
    std::optional<LiveConstants> constants;  ///< empty when the system has none
};

namespace {

/// The first number of this cycle's updates that is not finite, by groups, states and cells. None when
/// something else put it there, in a cycle that is remembered.
std::optional<NotFinite> find_not_finite(const Plan& plan, const State& state) {
    for (int group = 0; group < std::ssize(plan.groups); ++group) {
        const auto& g = plan.groups[group];
        if (g.pruned || state.groups[group].finite) continue;
        for (int s = 0; s < std::ssize(g.states); ++s) {
            const double* row = state_row(state.groups[group], g, s, state.cycle);
            for (Index cell = 0; cell < g.cells; ++cell)
                if (!std::isfinite(row[cell])) return NotFinite{group, s, cell, state.cycle, row[cell]};
        }
    }
    return std::nullopt;
}

[[noreturn]] void refuse_pruned(const std::string& what, std::string_view demand) {
    throw std::logic_error(
        fmt::format("{} is pruned: nothing that was demanded depends on it. To read it, call "
                    "Demand::{} before Simulation::build()",
                    what, demand));
}

void require_computed(const Plan& plan, int group) {
    if (plan.groups[group].pruned)
        refuse_pruned(fmt::format("group '{}'", plan.layout.groups[group].path), "read_group()");
}

}  // namespace

std::optional<Simulation> Simulation::build(const model::System& system, const Registry& registry,
                                            const Demand& demand, const Options& options,
                                            Diagnostics& diagnostics) {
    auto layout = make_layout(system, registry, diagnostics, options.environment);
    if (!layout) return std::nullopt;
    return build(system, std::move(*layout), demand, options, diagnostics);
}

std::optional<Simulation> Simulation::build(const model::System& system, Layout layout, const Demand& demand,
                                            const Options& options, Diagnostics& diagnostics) {
    return build(system, std::make_shared<const Layout>(std::move(layout)), demand, options, diagnostics, {});
}

std::optional<Simulation> Simulation::build(const model::System& system, std::shared_ptr<const Layout> layout,
                                            const Demand& demand, const Options& options,
                                            Diagnostics& diagnostics, std::shared_ptr<const Plan> plan) {
    Compiled compiled;
    if (plan && !plan->seed && plan->demand.covers(demand)) {
        compiled.state = std::make_unique<State>(*plan, options);
        compiled.plan = std::move(plan);
    } else {
        compiled = compile(system, std::move(layout), demand, options, diagnostics);
    }
    if (!compiled.plan) return std::nullopt;
    auto parts = std::make_unique<Parts>(std::move(compiled), options);
    if (!model::constant_names(system).empty()) parts->constants.emplace(system, parts->plan->layout);
    return Simulation(std::move(parts));
}

Simulation::Simulation(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::start() {
    parts_->cycle.start_modules();
    parts_->state->started = true;
}

void Simulation::step() {
    update_groups();
    update_modules();
    update_connections();
}

void Simulation::update_groups() {
    auto& [plan, state, cycle, executor, shared, running, shared_cycles, not_finite, constants] = *parts_;
    if (!state->started) throw RunError("the simulation is not started");
    state->shown = state->cycle;
    running = true;
    shared = executor && executor->begin();
    shared_cycles += shared;
    if (shared)
        executor->update_groups();
    else
        cycle.update_groups();
    if (!cycle.check_finite) return;
    if (std::ranges::all_of(state->groups, &GroupState::finite)) return;
    not_finite = find_not_finite(*plan, *state);
    cycle.check_finite = !not_finite;
}

void Simulation::update_modules() { parts_->cycle.update_modules(); }

void Simulation::update_connections() {
    auto& cycle = parts_->cycle;
    cycle.begin_deliveries();
    if (parts_->shared)
        parts_->executor->deliver();
    else
        cycle.deliver();
    if (parts_->executor) parts_->executor->end();
    parts_->running = false;
    ++parts_->state->cycle;
}

int Simulation::threads() const { return parts_->executor ? parts_->executor->threads() : 1; }
std::uint64_t Simulation::shared_cycles() const { return parts_->shared_cycles; }
std::uint64_t Simulation::cycle() const { return parts_->state->cycle; }
void Simulation::check_finite(bool wanted) { parts_->cycle.check_finite = wanted; }
const std::optional<NotFinite>& Simulation::not_finite() const { return parts_->not_finite; }

void Simulation::check(std::span<const model::Assignment> changes, Diagnostics& diagnostics) const {
    const auto& constants = parts_->constants;
    check_changes(*parts_->plan, *parts_->state,
                  constants ? expanded(*constants, layout(), changes, diagnostics)
                            : std::vector(changes.begin(), changes.end()),
                  diagnostics);
}

void Simulation::set(const model::Assignment& change) {
    if (parts_->running && !parts_->plan->overwritten)
        throw std::logic_error(
            "parameters change between cycles, not between update_groups() and update_connections()");
    if (!is_constant(change)) return set_parameter(*parts_->plan, *parts_->state, parts_->cycle, change);
    const auto changes = parts_->constants->changes(layout(), change);
    if (!changes)
        throw RunError(fmt::format("'{}': more than parameters depends on this constant", change.text));
    for (const auto& a : *changes) set_parameter(*parts_->plan, *parts_->state, parts_->cycle, a);
    parts_->constants->set(change);
}

void Simulation::replace_synapses(int connection, connectivity::Synapses synapses) {
    engine::replace_synapses(*parts_->plan, parts_->state->connections[connection], connection,
                             std::move(synapses));
}

const connectivity::Synapses& Simulation::replaced_synapses(int connection) const {
    return parts_->state->connections[connection].own;
}

void Simulation::set_synapse_state(int connection, int state, std::span<const double> values) {
    auto& now = *parts_->state;
    parts_->plan->connections[connection].plastic->set_state(now.numbers.data(), state, values);
    now.connections[connection].changed = true;
}

ParameterValue Simulation::parameter(const model::Assignment& which) const {
    if (is_constant(which)) return parts_->constants->value(which);
    return engine::parameter(*parts_->plan, *parts_->state, which);
}

void Simulation::checkpoint(Archive& archive) {
    parts_->state->checkpoint(*parts_->plan, archive);
    if (parts_->constants) parts_->constants->checkpoint(archive);
}

void Simulation::adopt(const Simulation& old, const Unchanged& unchanged) {
    engine::adopt(*parts_->plan, *parts_->state, *old.parts_->plan, *old.parts_->state, unchanged);
}

const Layout& Simulation::layout() const { return parts_->plan->layout; }
std::shared_ptr<const Plan> Simulation::plan() const { return parts_->plan; }
bool Simulation::pruned(int group) const { return parts_->plan->groups[group].pruned; }

ConstColumn Simulation::input(int group, InputKind kind) const {
    const auto& p = parts_->plan->groups[group];
    require_computed(*parts_->plan, group);
    if (!p.keeps_input)
        refuse_pruned(fmt::format("the input of group '{}'", layout().groups[group].path), "read_input()");
    const auto& g = parts_->state->groups[group];
    return {g.inputs[static_cast<std::size_t>(kind)][g.row], p.cells};
}

ConstColumn Simulation::state(int group, int state) const {
    require_computed(*parts_->plan, group);
    const auto& p = parts_->plan->groups[group];
    return {state_row(parts_->state->groups[group], p, state, parts_->state->shown), p.cells};
}

bool Simulation::in_place(int group, int state) const {
    require_computed(*parts_->plan, group);
    return parts_->state->groups[group].states[static_cast<std::size_t>(state)].depth == 1;
}

Column Simulation::output(int group) { return writable_state(group, layout().groups[group].type.output()); }

Column Simulation::writable_state(int group, int state) {
    require_computed(*parts_->plan, group);
    const auto& p = parts_->plan->groups[group];
    if (!p.overwritten)
        throw std::logic_error(
            fmt::format("group '{}' is not to be overwritten: nothing demanded that. Call "
                        "Demand::overwrite_group() before Simulation::build()",
                        layout().groups[group].path));
    parts_->cycle.invalidate(group);
    return {state_row(parts_->state->groups[group], p, state, parts_->state->shown), p.cells};
}

ConstColumn Simulation::module_output(int module, int port) const {
    const Column& out = parts_->state->modules[module].out[port];
    if (out.size() > 0 && !parts_->plan->modules[module].read[port]) {
        const auto& about = layout().modules[module];
        refuse_pruned(
            fmt::format("output '{}' of process '{}'", about.ports.outputs[port].port, about.process),
            "read_output()");
    }
    return {out.data(), out.size()};
}

bool Simulation::has_written(int module, int port) const {
    return parts_->state->modules[module].ever_written[port];
}

std::string_view Simulation::connection_form(int connection) const {
    const auto* kernel =
        kernel_of(parts_->plan->connections[connection], parts_->state->connections[connection]);
    return kernel ? kernel->form() : "pruned";
}

double Simulation::connection_cost(int connection) const {
    const auto& c = parts_->plan->connections[connection];
    return c.kernel ? c.kernel->cost() : 0;
}

std::size_t Simulation::synapses(int connection) const {
    return parts_->plan->connections[connection].synapses;
}

ConstColumn Simulation::synapse_state(int connection, int state) const {
    const auto& c = parts_->plan->connections[connection];
    const auto& now = *parts_->state;
    const auto& about = layout().connections[connection];
    if (!about.type.has_gain && !c.reads_states)
        refuse_pruned(fmt::format("what the synapses of connection '{}' keep", about.name),
                      "read_synapses()");
    return c.plastic ? c.plastic->state(now.numbers.data(), *now.connections[connection].workspace, state)
                     : ConstColumn(nullptr, 0);
}

std::span<const int> Simulation::synapse_sources(int connection) const {
    return parts_->plan->connections[connection].pre;
}

std::span<const int> Simulation::synapse_targets(int connection) const {
    return parts_->plan->connections[connection].post;
}

}  // namespace forage::engine
