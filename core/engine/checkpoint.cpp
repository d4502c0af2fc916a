// What of a simulation changes while it runs.
#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/engine/plan/plan.h"
#include "core/engine/simulation.h"

namespace forage::engine {
namespace {

/// The parameters that `object` holds. They may have changed since the start.
void keep(Archive& archive, const std::vector<Parameter>& parameters, void* object) {
    for (const auto& p : parameters) {
        ParameterValue value = p.get(object);
        std::visit([&](auto& v) { archive(v); }, value);
        if (archive.loading()) p.set(object, value);
    }
}

void keep(Archive& archive, GroupPlan& g) {
    archive.same(g.id, "a group");
    archive.same(g.cells, g.path);
    std::uint64_t drawn = 0;  // by this seed
    g.random.bits(0, {&drawn, 1});
    archive.same(drawn, "the seed");
    keep(archive, g.type.parameters, g.neuron->parameters());
    archive.same(g.pruned, "what is pruned");
    archive.same(g.keeps_input, "the inputs that are kept");
    archive(g.row, g.delivered, g.same_input, g.same_for, g.rests, g.changed, g.silent);
}

void keep(Archive& archive, ModulePlan& m) {
    if (!m.type.checkpoints)
        throw RunError(fmt::format(
            "{} of process '{}' cannot be part of a checkpoint: the type has members, and does not declare "
            "them with checkpoint(Archive&)",
            m.type.name, m.process));
    archive.same(m.process_id, "a process");
    archive.same(m.type.name, m.process);
    keep(archive, m.type.parameters, m.module->parameters());
    archive.same(m.read, "what is pruned");
    archive(m.written, m.changed, m.ever_written, m.last);
    try {
        m.module->checkpoint(archive);
    } catch (const ArchiveError&) {
        throw;
    } catch (...) {
        throw RunError(fmt::format("{} of process '{}' failed to take part in a checkpoint: {}", m.type.name,
                                   m.process, current_exception_message()));
    }
}

void keep(Archive& archive, ConnectionPlan& c) {
    archive.same(c.id, "a connection");
    archive.same(c.synapses, c.name);
    keep(archive, c.type.parameters, c.synapse->parameters());
    archive.same(c.pruned, "what is pruned");
    archive(c.changed);
}

}  // namespace

void Simulation::checkpoint(Archive& archive) {
    archive.same(plan_->groups.size(), "the number of groups");
    archive.same(plan_->modules.size(), "the number of modules");
    archive.same(plan_->connections.size(), "the number of connections");
    for (auto& g : plan_->groups) keep(archive, g);
    for (auto& m : plan_->modules) keep(archive, m);
    for (auto& c : plan_->connections) keep(archive, c);
    archive.same(plan_->arena.size(), "the memory");
    archive.numbers(plan_->arena.data(), plan_->arena.size());
    archive(started_, cycle_, shown_);
}

}  // namespace forage::engine
