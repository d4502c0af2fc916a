#include "core/engine/state.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/engine/run_error.h"

namespace forage::engine {
namespace {

/// Outputs of modules with more cells are not compared with what they were: only whether they are written.
constexpr Index most_compared_cells = 1024;

/// The parameters that `object` holds. They may have changed since the start.
void keep(Archive& archive, const std::vector<Parameter>& parameters, void* object) {
    for (const auto& p : parameters) {
        ParameterValue value = p.get(object);
        std::visit([&](auto& v) { archive(v); }, value);
        if (archive.loading()) p.set(object, value);
    }
}

/// Whether `bytes(i)` is the same for all numbers.
template <class Bytes>
bool all_same(const std::vector<int>& numbers, Bytes bytes) {
    return std::ranges::all_of(numbers,
                               [first = bytes(numbers.front()), &bytes](int i) { return bytes(i) == first; });
}

void keep(Archive& archive, const GroupPlan& plan, const Layout::Group& about, GroupState& g, BatchState& b) {
    archive.same(about.id, "a group");
    archive.same(plan.cells, about.path);
    std::uint64_t drawn = 0;  // by this seed
    plan.random.bits(0, {&drawn, 1});
    archive.same(drawn, "the seed");
    keep(archive, about.type.parameters, g.neuron->parameters());
    archive.same(plan.pruned, "what is pruned");
    archive.same(plan.keeps_input, "the inputs that are kept");
    archive(b.row, b.delivered, b.same_input, b.same_for, b.quiescent, b.changed, b.silent);
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

void keep(Archive& archive, const ConnectionPlan& plan, const Layout::Connection& about, ConnectionState& c,
          DeliveryState& d) {
    archive.same(about.id, "a connection");
    archive.same(plan.synapses, about.name);
    keep(archive, about.type.parameters, c.synapse->parameters());
    archive.same(plan.pruned, "what is pruned");
    archive(d.changed);
}

}  // namespace

void State::begin(const Plan& plan) {
    numbers.assign(plan.rows.size(), 0.0);
    const auto at = [&](Rows::Offset offset) { return numbers.data() + offset; };
    for (std::size_t i = 0; i < batches.size(); ++i) {
        const auto& p = plan.batches[i];
        const auto& type = plan.layout.groups[p.groups.front()].type;
        auto& b = batches[i];
        for (std::size_t s = 0; s < p.states.size(); ++s) {
            const auto [first, depth] = p.states[s];
            b.states.push_back({at(first), depth});
            for (std::int64_t row = 0; row < depth; ++row)
                std::fill_n(at(first) + row * p.stride, p.cells, type.states[s].initial);
        }
        for (std::size_t k = 0; k < input_kinds; ++k)
            for (std::size_t row = 0; row < 2; ++row) b.inputs[k][row] = at(p.inputs[k][row]);
        if (p.history > 0) b.past = at(p.past);
    }
    for (std::size_t i = 0; i < modules.size(); ++i) {
        const auto& about = plan.layout.modules[i];
        const auto cells = [&](int group) { return group < 0 ? 0 : plan.groups[group].cells; };
        auto& m = modules[i];
        for (const int g : about.input_groups) m.in.emplace_back(nullptr, cells(g));
        for (std::size_t port = 0; port < about.output_groups.size(); ++port) {
            const Index n = cells(about.output_groups[port]);
            m.out.emplace_back(at(plan.modules[i].outputs[port]), n);
            m.last.emplace_back(Eigen::ArrayXd::Zero(n <= most_compared_cells ? n : 0));
        }
        for (auto* flags : {&m.written, &m.changed, &m.ever_written}) flags->resize(m.out.size());
    }
    for (std::size_t i = 0; i < connections.size(); ++i) {
        const auto& p = plan.connections[i];
        if (p.pruned) continue;
        const int batch = plan.groups[p.target].batch;  // of this group alone, if there is feedback
        for (const int s : p.feedback) {
            const auto& target = batches[batch];
            connections[i].feedback.push_back(
                s < 0 ? Ring{nullptr, 1, 0}
                      : Ring{target.states[s].ring, target.states[s].depth, plan.batches[batch].stride});
        }
        if (p.plastic) p.plastic->begin(numbers.data());
        if (p.kernel) connections[i].workspace = p.kernel->make_workspace();
    }
    for (std::size_t i = 0; i < deliveries.size(); ++i)
        if (const auto& joint = plan.deliveries[i].joint) deliveries[i].workspace = joint->make_workspace();
}

void State::checkpoint(const Plan& plan, Archive& archive) {
    archive.same(groups.size(), "the number of groups");
    archive.same(modules.size(), "the number of modules");
    archive.same(connections.size(), "the number of connections");
    BatchState pruned_batch;
    DeliveryState pruned_delivery;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const int b = plan.groups[i].batch;
        keep(archive, plan.groups[i], plan.layout.groups[i], groups[i], b < 0 ? pruned_batch : batches[b]);
    }
    for (std::size_t i = 0; i < modules.size(); ++i)
        keep(archive, plan.modules[i], plan.layout.modules[i], modules[i]);
    for (std::size_t i = 0; i < connections.size(); ++i) {
        const int d = plan.connections[i].delivery;
        keep(archive, plan.connections[i], plan.layout.connections[i], connections[i],
             d < 0 ? pruned_delivery : deliveries[d]);
    }
    archive.same(numbers.size(), "the memory");
    archive.numbers(numbers.data(), numbers.size());
    archive(started, cycle, shown);
    if (!archive.loading()) return;
    for (const auto& b : plan.batches) compare_batch(plan, b.groups.front());
    for (const auto& d : plan.deliveries) compare_delivery(plan, d.connections.front());
}

void State::compare_batch(const Plan& plan, int group) {
    const int b = plan.groups[group].batch;
    if (b < 0) return;
    batches[b].alike = all_same(plan.batches[b].groups, [&](int i) {
        return parameter_bytes(plan.layout.groups[i].type.parameters, *groups[i].neuron);
    });
}

void State::compare_delivery(const Plan& plan, int connection) {
    const int d = plan.connections[connection].delivery;
    if (d < 0) return;
    deliveries[d].alike = all_same(plan.deliveries[d].connections, [&](int i) {
        return parameter_bytes(plan.layout.connections[i].type.parameters, *connections[i].synapse);
    });
}

std::string parameter_bytes(const std::vector<Parameter>& parameters, NeuronInstance& object) {
    Archive bytes;
    keep(bytes, parameters, object.parameters());
    return bytes.bytes();
}

std::string parameter_bytes(const std::vector<Parameter>& parameters, SynapseInstance& object) {
    Archive bytes;
    keep(bytes, parameters, object.parameters());
    return bytes.bytes();
}

}  // namespace forage::engine
