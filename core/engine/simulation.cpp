#include "core/engine/simulation.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/engine/plan.h"
#include "core/engine/thread_pool.h"
#include "core/model/validate.h"

namespace forage::engine {
namespace {

template <class T>
auto& at(std::vector<T>& all, int index) {
    return all[static_cast<std::size_t>(index)];
}

double* current_row(const GroupPlan& g, int state, std::uint64_t cycle) {
    const auto& s = g.states[static_cast<std::size_t>(state)];
    return s.ring + static_cast<Index>(cycle % static_cast<std::uint64_t>(s.depth)) * g.stride;
}

}  // namespace

std::optional<Simulation> Simulation::build(const model::System& system, const Registry& registry,
                                            Options options, Diagnostics& diagnostics) {
    const int errors_before = diagnostics.errors();
    model::validate(system, registry, diagnostics);
    if (diagnostics.errors() > errors_before) return std::nullopt;
    auto plan = compile(system, registry, options.seed,
                        options.general_forms ? Forms::general : Forms::fastest, diagnostics);
    if (!plan) return std::nullopt;
    return Simulation(std::move(plan), options);
}

Simulation::Simulation(std::unique_ptr<Plan> plan, const Options& options) : plan_(std::move(plan)) {
    std::size_t work = 0;
    for (const auto& g : plan_->groups) work += static_cast<std::size_t>(g.cells);
    for (const auto& c : plan_->connections) work += c.synapses;
    pool_ = std::make_unique<ThreadPool>(work < options.worth_sharing ? 1 : options.threads);
    std::size_t widest = 0;
    for (const auto& g : plan_->groups) widest = std::max(widest, static_cast<std::size_t>(g.stride));
    plan_->scratch.assign(static_cast<std::size_t>(pool_->threads()), std::vector<double>(widest));
}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::start() {
    for (auto& m : plan_->modules) {
        try {
            bind_inputs(m);
            ModuleFrame frame(0, m.in, m.out);
            m.module->start(m.ports, frame);
            deliver_outputs(m, 0);
        } catch (const std::exception& e) {
            throw RunError(
                fmt::format("{} of process '{}' could not start: {}", m.type.name, m.process, e.what()));
        }
    }
    started_ = true;
}

void Simulation::step() {
    update_groups();
    update_modules();
    update_connections();
}

void Simulation::update_groups() {
    if (!started_) throw RunError("the simulation is not started");
    shown_ = cycle_;
    const std::size_t now = cycle_ % 2;
    auto update = [this, now](int group, int thread) {
        auto& g = at(plan_->groups, group);
        try {
            NeuronColumns columns(g.cells, g.stride, cycle_,
                                  {g.inputs[0][now], g.inputs[1][now], g.inputs[2][now]}, g.states.data(),
                                  &g.random, at(plan_->scratch, thread).data());
            g.neuron->update(columns);
        } catch (const std::exception& e) {
            throw RunError(fmt::format("{} of group '{}' failed in cycle {}: {}", g.type.name, g.path, cycle_,
                                       e.what()));
        }
    };
    pool_->run(groups(), update);
}

/// Lets a module see the activity of this cycle; before the first one, zeros.
void Simulation::bind_inputs(ModulePlan& module) {
    for (std::size_t i = 0; i < module.in.size(); ++i)
        if (module.input_groups[i] >= 0) {
            const auto& g = at(plan_->groups, module.input_groups[i]);
            new (&module.in[i]) ConstColumn(current_row(g, g.type.output(), cycle_), g.cells);
        }
}

/// Adds what a module has written to the excitatory input of its groups; `turn` says which of their two rows.
void Simulation::deliver_outputs(const ModulePlan& module, std::size_t turn) {
    constexpr auto excitatory = static_cast<std::size_t>(InputKind::excitatory);
    for (std::size_t i = 0; i < module.out.size(); ++i) {
        if (module.output_groups[i] < 0) continue;
        auto& g = at(plan_->groups, module.output_groups[i]);
        if (g.type.reads[excitatory]) Column(g.inputs[excitatory][turn], g.cells) += module.out[i];
    }
}

void Simulation::update_modules() {
    const std::size_t next = (cycle_ + 1) % 2;
    for (auto& g : plan_->groups)
        for (std::size_t k = 0; k < input_kinds; ++k)
            if (g.type.reads[k]) Column(g.inputs[k][next], g.cells).setZero();

    const ModulePlan* current = nullptr;
    try {
        for (auto& m : plan_->modules) {
            current = &m;
            bind_inputs(m);
            ModuleFrame frame(cycle_, m.in, m.out);
            m.module->update(frame);
            deliver_outputs(m, next);
        }
    } catch (const std::exception& e) {
        throw RunError(fmt::format("{} of process '{}' failed in cycle {}: {}", current->type.name,
                                   current->process, cycle_, e.what()));
    }
}

void Simulation::update_connections() {
    const std::size_t next = (cycle_ + 1) % 2;
    for (auto& g : plan_->groups)
        if (g.history > 0) {
            const auto row = static_cast<Index>(cycle_ % static_cast<std::uint64_t>(g.history + 1));
            Column(g.history_ring + row * g.stride, g.cells) =
                ConstColumn(current_row(g, g.type.output(), cycle_), g.cells);
        }
    auto deliver = [this, next](int group, int) {
        auto& target = at(plan_->groups, group);
        for (const int connection : target.incoming) {
            auto& c = at(plan_->connections, connection);
            const auto& source = at(plan_->groups, c.source);
            const History history{current_row(source, source.type.output(), cycle_),
                                  {source.history_ring, source.history + 1, source.stride},
                                  cycle_};
            try {
                if (c.effective)
                    c.kernel->deliver(history, target.inputs[static_cast<std::size_t>(c.kind)][next]);
                else if (c.plastic)
                    c.plastic->learn(history);
            } catch (const std::exception& e) {
                throw RunError(fmt::format("{} of connection '{}' failed in cycle {}: {}", c.type.name,
                                           c.name, cycle_, e.what()));
            }
        }
    };
    pool_->run(groups(), deliver);
    ++cycle_;
}

int Simulation::threads() const { return pool_->threads(); }
int Simulation::groups() const { return static_cast<int>(plan_->groups.size()); }
const std::string& Simulation::path(int group) const { return at(plan_->groups, group).path; }
const std::string& Simulation::id(int group) const { return at(plan_->groups, group).id; }
GroupShape Simulation::shape(int group) const { return at(plan_->groups, group).shape; }
const NeuronType& Simulation::type(int group) const { return at(plan_->groups, group).type; }

ConstColumn Simulation::input(int group, InputKind kind) const {
    const auto& g = at(plan_->groups, group);
    return {g.inputs[static_cast<std::size_t>(kind)][shown_ % 2], g.cells};
}

ConstColumn Simulation::state(int group, int state) const {
    const auto& g = at(plan_->groups, group);
    return {current_row(g, state, shown_), g.cells};
}

Column Simulation::output(int group) {
    const auto& g = at(plan_->groups, group);
    return {current_row(g, g.type.output(), shown_), g.cells};
}

int Simulation::modules() const { return static_cast<int>(plan_->modules.size()); }
const std::string& Simulation::module_process(int module) const { return at(plan_->modules, module).process; }
const std::string& Simulation::module_type(int module) const { return at(plan_->modules, module).type.name; }
const ModulePorts& Simulation::module_ports(int module) const { return at(plan_->modules, module).ports; }
ConstColumn Simulation::module_output(int module, int port) const {
    const auto& out = at(plan_->modules, module).out[static_cast<std::size_t>(port)];
    return {out.data(), out.size()};
}

int Simulation::connections() const { return static_cast<int>(plan_->connections.size()); }
const std::string& Simulation::connection_id(int connection) const {
    return at(plan_->connections, connection).id;
}
const std::string& Simulation::connection_name(int connection) const {
    return at(plan_->connections, connection).name;
}
std::string_view Simulation::connection_form(int connection) const {
    return at(plan_->connections, connection).kernel->form();
}
std::size_t Simulation::synapses(int connection) const { return at(plan_->connections, connection).synapses; }
const SynapseType& Simulation::synapse_type(int connection) const {
    return at(plan_->connections, connection).type;
}
ConstColumn Simulation::synapse_state(int connection, int state) const {
    const auto& c = at(plan_->connections, connection);
    return c.plastic ? c.plastic->state(static_cast<std::size_t>(state)) : ConstColumn(nullptr, 0);
}

}  // namespace forage::engine
