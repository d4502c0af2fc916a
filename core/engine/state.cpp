#include "core/engine/state.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/engine/kernels/forms.h"
#include "core/engine/run_error.h"

namespace forage::engine {
namespace {

/// Outputs of modules with more cells are not compared with what they were: only whether they are written.
constexpr Index max_compared_cells = 1024;

/// The parameters that `object` holds. They may have changed since the start.
void keep(Archive& archive, const std::vector<Parameter>& parameters, void* object) {
    for (const auto& p : parameters) {
        ParameterValue value = p.get(object);
        std::visit([&](auto& v) { archive(v); }, value);
        if (archive.loading()) p.set(object, value);
    }
}

/// An object of a type with these parameters.
template <class Type>
auto make(const Type& type, const std::vector<ParameterValue>& parameters, double seconds_per_cycle) {
    auto out = type.make();
    for (std::size_t i = 0; i < parameters.size(); ++i)
        type.parameters[i].set(out->parameters(), parameters[i]);
    if constexpr (requires { type.set_dt; })
        if (type.set_dt) type.set_dt(out->parameters(), seconds_per_cycle);
    return out;
}

void keep(Archive& archive, const GroupPlan& plan, const Layout::Group& about, GroupState& g) {
    archive.same(about.id, "a group");
    archive.same(plan.cells, about.path);
    std::uint64_t drawn = 0;  // by this seed
    g.random.bits(0, {&drawn, 1});
    archive.same(drawn, "the seed");
    keep(archive, about.type.parameters, g.neuron->parameters());
    archive.same(plan.pruned, "what is pruned");
    archive.same(plan.keeps_input, "the inputs that are kept");
    archive(g.row, g.delivered, g.same_input, g.same_for, g.quiescent, g.changed, g.silent);
}

void keep(Archive& archive, const ModulePlan& plan, const Layout::Module& about, ModuleState& m) {
    if (!about.type.checkpoints)
        throw RunError(fmt::format(
            "{} of process '{}' cannot be part of a checkpoint: the type has members, and does not declare "
            "them with checkpoint(Archive&)",
            about.type.name, about.process));
    archive.same(about.process_id, "a process");
    archive.same(about.type.name, about.process);
    keep(archive, about.type.parameters, m.module->parameters());
    archive.same(plan.read, "what is pruned");
    archive(m.written, m.changed, m.ever_written, m.last);
    try {
        m.module->checkpoint(archive);
    } catch (const ArchiveError&) {
        throw;
    } catch (...) {
        std::throw_with_nested(
            RunError(fmt::format("{} of process '{}' failed to take part in a checkpoint: {}",
                                 about.type.name, about.process, current_exception_message())));
    }
}

/// Reads or writes synapses that a run has of its own.
void keep_own(Archive& archive, const Plan& plan, int connection, ConnectionState& c) {
    connectivity::Synapses own;
    if (!archive.loading()) own = c.own;
    archive(own.pre, own.post, own.delay, own.attenuation);
    if (!archive.loading()) return;
    const auto& p = plan.connections[connection];
    const auto fit = [&](const std::vector<int>& all, Index end) {
        return all.size() == own.size() && std::ranges::all_of(all, [&](int n) { return n >= 0 && n < end; });
    };
    if (own.size() == 0 || own.attenuation.size() != own.size() || !p.kernel || p.plastic ||
        !fit(own.pre, plan.groups[p.source].cells) || !fit(own.post, plan.groups[p.target].cells) ||
        !fit(own.delay, p.longest_delay + 1))
        throw ArchiveError("the synapses in the checkpoint are those of another connection");
    own.reference = 0;
    replace_synapses(plan, c, connection, std::move(own));
}

void keep(Archive& archive, const Plan& whole, int number, ConnectionState& c) {
    const auto& plan = whole.connections[number];
    const auto& about = whole.layout.connections[number];
    archive.same(about.id, "a connection");
    archive.same(plan.synapses, about.name);
    keep(archive, about.type.parameters, c.synapse->parameters());
    archive.same(plan.pruned, "what is pruned");
    constexpr std::uint8_t changed = 1, own = 2;
    auto flags = static_cast<std::uint8_t>((c.changed ? changed : 0) | (c.own_kernel ? own : 0));
    archive(flags);
    if (flags & own)
        keep_own(archive, whole, number, c);
    else if (archive.loading() && c.own_kernel)
        c.own = {}, c.own_kernel = nullptr, c.workspace = plan.kernel->make_workspace();
    c.changed = flags & changed;
}

}  // namespace

void replace_synapses(const Plan& plan, ConnectionState& c, int connection, connectivity::Synapses synapses) {
    const auto& p = plan.connections[connection];
    c.own = synapses;
    c.own_kernel = make_kernel(std::move(synapses), plan.layout.groups[p.source].shape,
                               plan.layout.groups[p.target].shape, Forms::fastest);
    c.workspace = c.own_kernel->make_workspace();
    c.changed = true;
}

State::State(const Plan& plan, const Options& options)
    : groups(plan.groups.size()), modules(plan.modules.size()), connections(plan.connections.size()) {
    const double dt = plan.layout.seconds_per_cycle;
    numbers.assign(plan.rows.size(), 0.0);
    const auto at = [&](Rows::Offset offset) { return numbers.data() + offset; };
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto& p = plan.groups[i];
        const auto& type = plan.layout.groups[i].type;
        auto& g = groups[i];
        g.neuron = make(type, p.parameters, dt);
        g.random = RandomStream(options.seed, plan.layout.groups[i].id);
        if (p.pruned) continue;
        for (std::size_t s = 0; s < p.states.size(); ++s) {
            const auto [first, depth] = p.states[s];
            g.states.push_back({at(first), depth});
            for (std::int64_t row = 0; row < depth; ++row)
                std::fill_n(at(first) + row * p.stride, p.cells, type.states[s].initial);
        }
        for (std::size_t k = 0; k < type.input_count(); ++k)
            for (std::size_t row = 0; row < 2; ++row) g.inputs[k][row] = at(p.inputs[k][row]);
        if (p.history > 0) g.past = at(p.past);
    }
    for (std::size_t i = 0; i < modules.size(); ++i) {
        const auto& about = plan.layout.modules[i];
        const auto cells = [&](int group) { return group < 0 ? 0 : plan.groups[group].cells; };
        auto& m = modules[i];
        m.module = make(about.type, plan.modules[i].parameters, dt);
        m.ports = about.ports;
        m.ports.random = RandomStream(options.seed, about.process_id);
        m.ports.environment = options.environment;
        m.ports.seed = options.seed;
        m.ports.directory = options.directory;
        if (options.open)
            m.ports.open = [open = options.open, process = about.process](
                               const std::string& name) -> std::ostream& { return open(process, name); };
        for (const int g : about.input_groups) m.in.emplace_back(nullptr, cells(g));
        for (std::size_t port = 0; port < about.output_groups.size(); ++port) {
            const Index n = cells(about.output_groups[port]);
            m.out.emplace_back(at(plan.modules[i].outputs[port]), n);
            m.last.emplace_back(Eigen::ArrayXd::Zero(n <= max_compared_cells ? n : 0));
        }
        for (auto* flags : {&m.written, &m.changed, &m.ever_written}) flags->resize(m.out.size());
    }
    for (std::size_t i = 0; i < connections.size(); ++i) {
        const auto& p = plan.connections[i];
        connections[i].synapse = make(plan.layout.connections[i].type, p.parameters, dt);
        if (p.pruned) continue;
        for (std::size_t f = 0; f < p.feedback.size(); ++f) {
            const int s = p.feedback[f];
            const auto& target = groups[p.target];
            connections[i].feedback.push_back(s < 0 ? Ring{nullptr, 1, 0}
                                                    : Ring{target.states[s].ring, target.states[s].depth,
                                                           plan.groups[p.target].stride,
                                                           plan.layout.connections[i].type.feedback[f].ago});
        }
        if (p.plastic) p.plastic->begin(numbers.data());
        if (p.kernel) connections[i].workspace = p.kernel->make_workspace();
    }
    for (const auto& first : plan.first_numbers) {
        if (first.group < 0) {
            const auto* plastic = plan.connections[first.connection].plastic;
            if (plastic) plastic->set_state(numbers.data(), first.state, first.values);
            continue;
        }
        const auto& ring = groups[first.group].states[first.state];
        for (std::int64_t row = 0; row < ring.depth; ++row)
            std::ranges::copy(first.values, ring.ring + row * plan.groups[first.group].stride);
    }
}

void State::checkpoint(const Plan& plan, Archive& archive) {
    archive.same(groups.size(), "the number of groups");
    archive.same(modules.size(), "the number of modules");
    archive.same(connections.size(), "the number of connections");
    for (std::size_t i = 0; i < groups.size(); ++i)
        keep(archive, plan.groups[i], plan.layout.groups[i], groups[i]);
    for (std::size_t i = 0; i < modules.size(); ++i)
        keep(archive, plan.modules[i], plan.layout.modules[i], modules[i]);
    for (std::size_t i = 0; i < connections.size(); ++i)
        keep(archive, plan, static_cast<int>(i), connections[i]);
    archive.same(numbers.size(), "the memory");
    archive.numbers(numbers.data(), numbers.size());
    archive(started, cycle, shown);
}

}  // namespace forage::engine
