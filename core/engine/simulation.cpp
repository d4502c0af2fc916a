#include "core/engine/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/engine/early_delivery.h"
#include "core/engine/group_cycle.h"
#include "core/engine/group_delivery.h"
#include "core/engine/group_update.h"
#include "core/engine/parallel/parallel_executor.h"
#include "core/engine/plan/plan.h"

namespace forage::engine {
namespace {

template <class T>
auto& at(std::vector<T>& all, int index) {
    return all[static_cast<std::size_t>(index)];
}

/// The first number of a group's update that is not finite, by states, then by cells. None when somebody
/// else put it there, in a cycle that is remembered.
std::optional<NotFinite> find_not_finite(const GroupPlan& g, int group, std::uint64_t cycle) {
    for (std::size_t state = 0; state < g.states.size(); ++state) {
        const double* row = state_row(g, state, cycle);
        for (Index cell = 0; cell < g.cells; ++cell)
            if (!std::isfinite(row[cell]))
                return NotFinite{group, static_cast<int>(state), cell, cycle, row[cell]};
    }
    return std::nullopt;
}

[[noreturn]] void refuse_pruned(const std::string& what, std::string_view demand) {
    throw std::logic_error(
        fmt::format("{} is pruned: nothing that was demanded depends on it. To read it, call "
                    "Demand::{} before Simulation::build()",
                    what, demand));
}

/// A group to read. Throws std::logic_error when it is pruned.
GroupPlan& computed(std::vector<GroupPlan>& groups, int group) {
    auto& g = groups[group];
    if (g.pruned) refuse_pruned(fmt::format("group '{}'", g.path), "read_group()");
    return g;
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
    auto plan = compile(system, std::move(layout), demand, options.seed,
                        options.general_forms ? Forms::general : Forms::fastest, diagnostics);
    if (!plan) return std::nullopt;
    return Simulation(std::move(plan), options);
}

Simulation::Simulation(std::unique_ptr<Plan> plan, const Options& options)
    : plan_(std::move(plan)), parallel_threshold_ns_(options.parallel_threshold_ns) {
    std::size_t widest = 0, most_compared = 0;
    for (auto& g : plan_->groups) {
        widest = std::max(widest, static_cast<std::size_t>(g.stride));
        most_compared = std::max(most_compared, compared_numbers(g));
    }
    for (auto& m : plan_->modules) m.ports.environment = options.environment;
    estimate_deliveries(*plan_);
    early_ = std::make_unique<EarlyDelivery>(*plan_);
    if (options.threads > 1 && update_cost(*plan_) + delivery_cost(*plan_) >= parallel_threshold_ns_)
        shared_cycle_ = std::make_unique<ParallelExecutor>(*plan_, options.threads, options.min_task_ns);
    for (int t = 0; t < threads(); ++t)  // not touched, and so not in memory, until a type draws numbers
        plan_->scratch.push_back(
            std::make_unique_for_overwrite<double[]>(widest * std::size_t{NeuronColumns::scratch_columns}));
    plan_->before.assign(static_cast<std::size_t>(threads()), std::vector<double>(most_compared));
}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::start() {
    for (auto& m : plan_->modules) {
        try {
            bind_inputs(m);
            ModuleFrame frame(0, m.in, m.out, &m.written, &m.read);
            m.module->start(m.ports, frame);
        } catch (...) {
            throw RunError(fmt::format("{} of process '{}' could not start: {}", m.type.name, m.process,
                                       current_exception_message()));
        }
        note_changes(m);
    }
    for (const int i : plan_->updated) receive_from_modules(*plan_, at(plan_->groups, i));
    started_ = true;
}

void Simulation::step() {
    update_groups(true);
    update_modules();
    update_connections();
}

/// Whether threads share the cycle that begins.
bool Simulation::begin_sharing() {
    if (!shared_cycle_) return false;
    if (parallel_threshold_ns_ == 0) return true;
    return trial_.begin(
        [&] { return update_cost(*plan_) + delivery_cost(*plan_) >= parallel_threshold_ns_; });
}

void Simulation::update_alone() {
    const UpdateFrame frame{cycle_, plan_->scratch[0].get(), plan_->before[0].data(), plan_->checks_finite};
    for (std::size_t k = 0; k < plan_->updated.size(); ++k) {
        auto& g = at(plan_->groups, plan_->updated[k]);
        update(g, frame);
        if (!delivers_early_) continue;
        remember(g, cycle_);
        for (const int i : early_->after(k)) deliver_early(i);
    }
}

/// A failure waits until its turn comes: groups that fail in their updates come first.
void Simulation::deliver_early(int group) {
    failed_delivery_.guard(group, 0, [&] { deliver_to(*plan_, at(plan_->groups, group), cycle_); });
}

void Simulation::deliver_late() {
    for (const int i : early_->late()) {
        if (failed_delivery_.before(i)) break;
        deliver_to(*plan_, at(plan_->groups, i), cycle_);
    }
    failed_delivery_.raise();
}

void Simulation::update_groups() { update_groups(!plan_->overwritten); }

void Simulation::update_groups(bool deliver_early) {
    if (!started_) throw RunError("the simulation is not started");
    shown_ = cycle_;
    shared_ = begin_sharing();
    shared_cycles_ += shared_;
    delivers_early_ = deliver_early;
    failed_delivery_.forget();
    if (shared_)
        shared_cycle_->update_groups(cycle_, deliver_early);
    else
        update_alone();
    if (!plan_->checks_finite) return;
    for (const int i : plan_->updated)
        if (!at(plan_->groups, i).finite) {
            not_finite_ = find_not_finite(at(plan_->groups, i), i, cycle_);
            plan_->checks_finite = !not_finite_;
            if (not_finite_) return;
        }
}

/// Lets a module see the activity of this cycle; before the first one, zeros.
void Simulation::bind_inputs(ModulePlan& module) {
    for (std::size_t i = 0; i < module.in.size(); ++i)
        if (module.input_groups[i] >= 0) {
            const auto& g = at(plan_->groups, module.input_groups[i]);
            new (&module.in[i]) ConstColumn(activity_row(g, cycle_), g.cells);
        }
}

void Simulation::update_modules() {
    for (auto& m : plan_->modules) {
        try {
            bind_inputs(m);
            ModuleFrame frame(cycle_, m.in, m.out, &m.written, &m.read);
            m.module->update(frame);
        } catch (...) {
            throw RunError(fmt::format("{} of process '{}' failed in cycle {}: {}", m.type.name, m.process,
                                       cycle_, current_exception_message()));
        }
        note_changes(m);
    }
}

void Simulation::update_connections() {
    const bool early = std::exchange(delivers_early_, false);
    if (!early)
        for (const int i : plan_->updated) remember(at(plan_->groups, i), cycle_);
    if (shared_)
        shared_cycle_->deliver(cycle_);
    else if (early)
        deliver_late();
    else
        for (const int i : plan_->updated) deliver_to(*plan_, at(plan_->groups, i), cycle_);
    trial_.end();
    ++cycle_;
}

void Simulation::check_finite(bool wanted) { plan_->checks_finite = wanted; }

GroupPlan& Simulation::overwritten(int group) {
    auto& g = computed(plan_->groups, group);
    if (!g.overwritten)
        throw std::logic_error(
            fmt::format("group '{}' is not to be overwritten: nothing demanded that. Call "
                        "Demand::overwrite_group() before Simulation::build()",
                        g.path));
    touch(g, cycle_);
    return g;
}

void Simulation::invalidate(int group) { touch(plan_->groups[group], cycle_); }

int Simulation::threads() const { return shared_cycle_ ? shared_cycle_->threads() : 1; }
const Layout& Simulation::layout() const { return plan_->layout; }
bool Simulation::pruned(int group) const { return plan_->groups[group].pruned; }

ConstColumn Simulation::input(int group, InputKind kind) const {
    const auto& g = computed(plan_->groups, group);
    if (!g.keeps_input) refuse_pruned(fmt::format("the input of group '{}'", g.path), "read_input()");
    return {g.inputs[static_cast<std::size_t>(kind)][g.row], g.cells};
}

ConstColumn Simulation::state(int group, int state) const {
    const auto& g = computed(plan_->groups, group);
    return {state_row(g, static_cast<std::size_t>(state), shown_), g.cells};
}

Column Simulation::output(int group) {
    auto& g = overwritten(group);
    return {activity_row(g, shown_), g.cells};
}

Column Simulation::writable_state(int group, int state) {
    auto& g = overwritten(group);
    return {state_row(g, static_cast<std::size_t>(state), shown_), g.cells};
}

ConstColumn Simulation::module_output(int module, int port) const {
    const auto& m = at(plan_->modules, module);
    const auto i = static_cast<std::size_t>(port);
    if (m.out[i].size() > 0 && !m.read[i])
        refuse_pruned(fmt::format("output '{}' of process '{}'", m.ports.outputs[i].port, m.process),
                      "read_output()");
    return {m.out[i].data(), m.out[i].size()};
}
bool Simulation::has_written(int module, int port) const {
    return at(plan_->modules, module).ever_written[static_cast<std::size_t>(port)];
}

std::string_view Simulation::connection_form(int connection) const {
    return at(plan_->connections, connection).kernel->form();
}
std::size_t Simulation::synapses(int connection) const { return at(plan_->connections, connection).synapses; }
ConstColumn Simulation::synapse_state(int connection, int state) const {
    const auto& c = at(plan_->connections, connection);
    if (c.plastic && c.pruned) refuse_pruned(fmt::format("connection '{}'", c.name), "read_synapses()");
    return c.plastic ? c.plastic->state(static_cast<std::size_t>(state)) : ConstColumn(nullptr, 0);
}

}  // namespace forage::engine
