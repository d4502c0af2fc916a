#include "core/model/edit.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/lookup.h"

namespace forage::model {
namespace {

/// The things of a system that have parameters, by the name that a person writes before the dot.
struct Owner {
    TypeUse* use = nullptr;
    const std::vector<Parameter>* parameters = nullptr;
    Process* process = nullptr;  ///< when the owner is a process
};

std::vector<Owner> find_owners(System& system, const Registry& registry, std::string_view where) {
    std::vector<Owner> owners;
    for (const auto& entry : find_groups(system, where)) {
        auto& use =
            const_cast<Group*>(entry.group)->neuron;  // entry points into `system`, which we may change
        const NeuronType* type = registry.neuron(use.type);
        owners.push_back({&use, type ? &type->parameters : nullptr, nullptr});
    }
    if (Group* by_id = find_group(system, where); owners.empty() && by_id) {
        const NeuronType* type = registry.neuron(by_id->neuron.type);
        owners.push_back({&by_id->neuron, type ? &type->parameters : nullptr, nullptr});
    }
    if (!owners.empty()) return owners;
    for (auto& p : system.processes)
        if (trim(p.name) == trim(where) || p.id == where) {
            const ModuleType* type = p.module ? registry.module(p.module->type) : nullptr;
            owners.push_back({p.module ? &*p.module : nullptr, type ? &type->parameters : nullptr, &p});
        }
    for (auto& c : system.connections)
        if (c.synapse && (trim(c.name) == trim(where) || c.id == where)) {
            const SynapseType* type = registry.synapse(c.synapse->type);
            owners.push_back({&*c.synapse, type ? &type->parameters : nullptr, nullptr});
        }
    return owners;
}

std::string suggest_owner(std::string_view where, const System& system) {
    const auto groups = group_paths(system);
    const std::string by_name = suggest_group(where, groups);
    std::vector<std::string> all = groups;
    for (const auto& p : system.processes) all.emplace_back(trim(p.name));
    for (const auto& c : system.connections) all.emplace_back(trim(c.name));
    const bool near_a_group = by_name.starts_with("did you mean");
    return near_a_group ? by_name : suggest(where, all);
}

}  // namespace

void set(System& system, const Registry& registry, std::string_view assignment, Diagnostics& diagnostics) {
    const auto problem = [&](std::string message, std::string hint) {
        diagnostics.error({}, fmt::format("--set '{}': {}", assignment, message), std::move(hint));
    };
    const auto equals = assignment.find('=');
    const auto dot = assignment.rfind('.', equals);
    if (equals == std::string_view::npos || dot == std::string_view::npos || dot == 0) {
        problem("not an assignment",
                "write Process/Group.parameter=value, for example 'Reactive Layer/Approach.threshold=0.3'");
        return;
    }
    const std::string_view where = trim(assignment.substr(0, dot));
    const std::string name(trim(assignment.substr(dot + 1, equals - dot - 1)));
    const std::string value(trim(assignment.substr(equals + 1)));

    const auto owners = find_owners(system, registry, where);
    if (owners.empty()) return problem(fmt::format("there is no '{}'", where), suggest_owner(where, system));
    if (owners.size() > 1)
        return problem(fmt::format("'{}' names {} things", where, owners.size()),
                       "add '#' and the id of the group you mean, or use the id of the connection");
    const Owner& owner = owners.front();

    if (owner.process && name == "enableModule") {
        const auto flag = parse_parameter(ParameterKind::boolean, value);
        if (!flag) return problem(fmt::format("'{}' is not true or false", value), "");
        owner.process->module_enabled = std::get<bool>(*flag);
        return;
    }
    if (!owner.parameters)
        return problem(owner.use ? fmt::format("the type '{}' is not known", owner.use->type)
                                 : "this process has no module",
                       "");
    const auto it = std::find_if(owner.parameters->begin(), owner.parameters->end(),
                                 [&](const auto& p) { return p.name == name; });
    if (it == owner.parameters->end()) {
        std::vector<std::string> known;
        for (const auto& p : *owner.parameters) known.push_back(p.name);
        if (owner.process) known.emplace_back("enableModule");
        return problem(fmt::format("{} has no parameter '{}'", owner.use->type, name), suggest(name, known));
    }
    const auto parsed = parse_parameter(it->kind, value);
    if (!parsed) return problem(fmt::format("'{}' is not {}", value, describe(it->kind)), it->doc);
    if (outside(*parsed, it->range))
        diagnostics.warning({}, fmt::format("--set '{}': outside the usual range {} to {}", assignment,
                                            to_text(it->range->low), to_text(it->range->high)));
    set_parameter(*owner.use, name, value);
}

}  // namespace forage::model
