#include "core/model/edit.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/expression.h"
#include "core/model/lookup.h"

namespace forage::model {
namespace {

/// An item of a system that has parameters, found by the name before the dot.
struct Owner {
    Assignment::Owner kind;
    std::string id;
    const TypeUse* use = nullptr;                        ///< null for a process without a module
    const std::vector<Parameter>* parameters = nullptr;  ///< null when the type is unknown
};

template <class Type>
const std::vector<Parameter>* parameters_of(const Type* type) {
    return type ? &type->parameters : nullptr;
}

std::vector<Owner> find_owners(const System& system, const Registry& registry, std::string_view where) {
    std::vector<Owner> owners;
    const auto add_group = [&](const Group& g) {
        owners.push_back(
            {Assignment::Owner::group, g.id, &g.neuron, parameters_of(registry.neuron(g.neuron.type))});
    };
    for (const auto& entry : find_groups(system, where)) add_group(*entry.group);
    if (const auto* by_id = GroupIndex(system).find(where).group; owners.empty() && by_id) add_group(*by_id);
    if (!owners.empty()) return owners;
    for (const auto& p : system.processes)
        if (trim(p.name) == trim(where) || p.id == where)
            owners.push_back({Assignment::Owner::process, p.id, p.module ? &*p.module : nullptr,
                              p.module ? parameters_of(registry.module(p.module->type)) : nullptr});
    for (const auto& c : system.connections)
        if (c.synapse && (trim(c.name) == trim(where) || c.id == where))
            owners.push_back({Assignment::Owner::connection, c.id, &*c.synapse,
                              parameters_of(registry.synapse(c.synapse->type))});
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

/// A hint for a name that several items have.
std::string which(const std::vector<Owner>& owners, std::string_view where) {
    std::vector<std::string> names;
    for (const auto& o : owners)
        names.push_back(o.kind == Assignment::Owner::group ? fmt::format("{}#{}", trim(where), o.id) : o.id);
    return fmt::format("use one of '{}'", fmt::join(names, "', '"));
}

}  // namespace

std::optional<Assignment> parse_assignment(const System& system, const Registry& registry,
                                           std::string_view text, std::string_view what,
                                           Diagnostics& diagnostics, Location at) {
    const expression::Context context{text, what, diagnostics, at};
    const auto said = context.parsed(&expression::parse_assignment);
    if (!said) return std::nullopt;
    const auto& [where, parameter, value] = *said;
    const auto problem = [&](const expression::Piece& piece, std::string message, std::string hint) {
        context.error(piece.at, std::move(message), std::move(hint));
        return std::nullopt;
    };
    const auto owners = find_owners(system, registry, where.text);
    if (owners.empty())
        return problem(where, fmt::format("there is no '{}'", where.text), suggest_owner(where.text, system));
    if (owners.size() > 1)
        return problem(where, fmt::format("'{}' names {} items", where.text, owners.size()),
                       which(owners, where.text));
    const Owner& owner = owners.front();

    Assignment out{owner.kind, owner.id, nullptr, {}, std::string(text), at};
    const bool is_process = owner.kind == Assignment::Owner::process;
    if (is_process && parameter.text == "enableModule") {
        const auto flag = parse_parameter(ParameterKind::boolean, value.text);
        if (!flag) return problem(value, fmt::format("'{}' is not true or false", value.text), "");
        out.value = *flag;
        return out;
    }
    if (!owner.parameters)
        return problem(where,
                       owner.use ? fmt::format("the type '{}' is not known", owner.use->type)
                                 : "this process has no module",
                       "");
    const auto it = std::find_if(owner.parameters->begin(), owner.parameters->end(),
                                 [&name = parameter.text](const auto& p) { return p.name == name; });
    if (it == owner.parameters->end()) {
        std::vector<std::string> known;
        for (const auto& p : *owner.parameters) known.push_back(p.name);
        if (is_process) known.emplace_back("enableModule");
        return problem(parameter, fmt::format("{} has no parameter '{}'", owner.use->type, parameter.text),
                       suggest(parameter.text, known));
    }
    const auto parsed = parse_parameter(it->kind, value.text);
    if (!parsed)
        return problem(value, fmt::format("'{}' is not {}", value.text, describe(it->kind)), it->doc);
    if (outside(*parsed, it->range))
        diagnostics.warning(at, fmt::format("{} '{}': outside the usual range {} to {}", what, text,
                                            to_text(it->range->low), to_text(it->range->high)));
    out.parameter = &*it;
    out.value = it->is_path ? ParameterValue(resolved(value.text, at)) : *parsed;
    return out;
}

void set(System& system, const Assignment& a) {
    if (a.owner == Assignment::Owner::process && !a.parameter) {
        find_process(system, a.id)->module_enabled = std::get<bool>(a.value);
        return;
    }
    TypeUse* use = nullptr;
    switch (a.owner) {
        case Assignment::Owner::group:
            use = &find_group(system, a.id)->neuron;
            break;
        case Assignment::Owner::process:
            use = &*find_process(system, a.id)->module;
            break;
        case Assignment::Owner::connection:
            use = &*find_connection(system, a.id)->synapse;
            break;
    }
    const bool as_written = !a.parameter->is_path;
    set_parameter(*use, a.parameter->name,
                  as_written ? std::string(trim(std::string_view(a.text).substr(a.text.find('=') + 1)))
                             : to_text(a.value));
}

void set(System& system, const Registry& registry, std::string_view assignment, Diagnostics& diagnostics,
         Location at) {
    const std::string_view what = at.file ? "set" : "--set";
    if (const auto a = parse_assignment(system, registry, assignment, what, diagnostics, std::move(at)))
        set(system, *a);
}

}  // namespace forage::model
