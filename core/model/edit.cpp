#include "core/model/edit.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include <fmt/format.h>

#include "core/base/printable.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/arrays.h"
#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/expression.h"
#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/model/parts.h"

namespace forage::model {
namespace {

/// An item of a system that has parameters, found by the name before the dot.
struct Owner {
    Assignment::Owner kind;
    std::string id;
    const TypeUse* use = nullptr;                        ///< null for a process without a module
    const std::vector<Parameter>* parameters = nullptr;  ///< null when the type is unknown
};

std::vector<Owner> find_owners(const System& system, const Registry& registry, std::string_view where) {
    std::vector<Owner> owners;
    const auto add = [&](Assignment::Owner kind, const std::string& id, const TypeUse* use) {
        owners.push_back({kind, id, use, use ? parameters_of(registry, kind, use->type) : nullptr});
    };
    for (const auto& [process, group] : find_groups(system, where))
        add(Assignment::Owner::group, group->id, &group->neuron);
    if (!owners.empty()) return owners;
    for (const int i : items_named(system.processes, where)) {
        const Process& p = system.processes[i];
        add(Assignment::Owner::process, p.id, p.module ? &*p.module : nullptr);
    }
    for (const int i : items_named(system.connections, where))
        if (const Connection& c = system.connections[i]; c.synapse)
            add(Assignment::Owner::connection, c.id, &*c.synapse);
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
    return fmt::format("use one of '{}'", separated(names, "', '"));
}

/// The item that `where` names. Reports an unknown name, and one that several items have.
std::optional<Owner> find_owner(const System& system, const Registry& registry,
                                const expression::Piece& where, const expression::Context& context) {
    const auto owners = find_owners(system, registry, where.text);
    if (owners.size() == 1) return owners.front();
    if (owners.empty())
        context.error(where.at, fmt::format("there is no '{}'", where.text),
                      suggest_owner(where.text, system));
    else
        context.error(where.at, fmt::format("'{}' names {} items", where.text, owners.size()),
                      which(owners, where.text));
    return std::nullopt;
}

/// The assignment to a constant that a text before '=' names; its value is still unset. Empty when there is
/// none.
std::optional<Assignment> resolve_constant(const System& system, std::string_view name,
                                           const expression::Context& context) {
    name = trim(name);
    if (!find_constant(system, name)) return std::nullopt;
    return Assignment{Assignment::Owner::constant, std::string(name), nullptr, {},
                      std::string(context.text),   context.at};
}

/// Gives a constant the value of its assignment, and all that depends on it. Reports what is wrong then.
void set_constant(System& system, const Assignment& a, Diagnostics& diagnostics) {
    Constant& constant = *find_constant(system, a.id);
    constant.value = trim(std::string_view(a.text).substr(a.text.find('=') + 1));
    constant.value_at = a.at;
    for (auto& p : system.processes)
        for (const Constant& own : p.constants)
            if (&own == &constant && p.linked()) constant.given = true, give(p.placeholder.front(), constant);
    compute(system, diagnostics);
}

/// The process whose constants hold in the item of an assignment; null when only those of the system do.
const Process* scope_of(const System& system, const Assignment& a) {
    const GroupIndex groups(system);
    switch (a.owner) {
        case Assignment::Owner::group:
            return groups.find(a.id).process;
        case Assignment::Owner::process:
            return find_by(system.processes, a.id, &Process::id);
        case Assignment::Owner::connection:
            return model::scope_of(*find_by(system.connections, a.id, &Connection::id), groups);
        case Assignment::Owner::constant:
            break;
    }
    return nullptr;
}

/// What a formula gives a parameter. Reports mistakes.
ParameterValue formula_value(const System& system, const Assignment& a, const expression::Piece& formula,
                             const expression::Context& context) {
    const auto kind = a.parameter ? a.parameter->kind : ParameterKind::boolean;
    try {
        const auto v = Constants(system).value(formula.text, scope_of(system, a));
        const std::string text = v ? to_text(*v) : "";
        if (const auto parsed = parse_parameter(kind, text)) return *parsed;
        context.error(formula.at, v ? fmt::format("'{}' is {}, not {}", formula.text, text, describe(kind))
                                    : fmt::format("a constant in '{}' has no value", formula.text));
    } catch (const FormulaError& e) {
        context.error(formula.at + e.at, e.what(), e.hint);
    }
    return {};
}

/// Resolves the owner and the parameter of an assignment; the value is still unset.
std::optional<Assignment> resolve(const System& system, const Registry& registry,
                                  const expression::Assignment& said, const expression::Context& context) {
    const auto& [where, parameter, value] = said;
    const auto problem = [&](const expression::Piece& piece, std::string message, std::string hint) {
        context.error(piece.at, std::move(message), std::move(hint));
        return std::nullopt;
    };
    const auto found = find_owner(system, registry, where, context);
    if (!found) return std::nullopt;
    const Owner& owner = *found;

    Assignment out{owner.kind, owner.id, nullptr, {}, std::string(context.text), context.at};
    const bool is_process = owner.kind == Assignment::Owner::process;
    if (is_process && parameter.text == "enableModule") return out;
    if (!owner.parameters)
        return problem(where,
                       owner.use ? fmt::format("the type '{}' is not known", owner.use->type)
                                 : "this process has no module",
                       "");
    out.parameter = find_by(*owner.parameters, parameter.text, &Parameter::name);
    if (!out.parameter) {
        auto known = names_of(*owner.parameters);
        if (is_process) known.emplace_back("enableModule");
        return problem(parameter, fmt::format("{} has no parameter '{}'", owner.use->type, parameter.text),
                       suggest(parameter.text, known));
    }
    return out;
}

/// The use of a type that has the parameter.
template <class S>  // System or const System
auto& use_of(S& system, const Assignment& a) {
    if (auto* use = find_use(system, a.id)) return *use;
    no_item("group", a.id);
}

}  // namespace

const std::vector<Parameter>* parameters_of(const Registry& registry, Assignment::Owner owner,
                                            std::string_view type) {
    const auto of = [](const auto* found) { return found ? &found->parameters : nullptr; };
    return owner == Assignment::Owner::group     ? of(registry.neuron(type))
           : owner == Assignment::Owner::process ? of(registry.module(type))
                                                 : of(registry.synapse(type));
}

std::optional<Assignment> find_parameter(const System& system, const Registry& registry,
                                         std::string_view name, std::string_view what,
                                         Diagnostics& diagnostics) {
    if (auto constant = resolve_constant(system, name, {name, what, diagnostics})) return constant;
    const std::string text = fmt::format("{}=", name);
    if (const auto said = expression::Context{text, what, diagnostics}.parsed(&expression::parse_assignment))
        return resolve(system, registry, *said, {name, what, diagnostics});
    return std::nullopt;
}

std::string assignment_name(const System& system, Assignment::Owner owner, const std::string& id) {
    std::string name = name_of(system, id);
    const auto named = find_owners(system, Registry(), name);
    const bool alone = named.size() == 1 && named.front().kind == owner && named.front().id == id;
    if (!alone || name.find('"') != name.npos) name = id;  // names have no escape for quotes
    return name.find('=') == name.npos ? name : fmt::format("\"{}\"", name);
}

std::string assignment_text(const System& system, const Assignment& a) {
    return fmt::format("{}.{}={}", assignment_name(system, a.owner, a.id), a.parameter->name,
                       to_text(a.value));
}

std::vector<std::string> parameter_names(const System& system, const Registry& registry) {
    std::vector<std::string> out;
    each_item(system, [&](Assignment::Owner owner, const auto& item, const TypeUse* use) {
        if constexpr (requires { item.module_enabled; })
            if (!item.module_enabled) return;
        const auto* parameters = use ? parameters_of(registry, owner, use->type) : nullptr;
        if (!parameters || parameters->empty()) return;
        const auto where = assignment_name(system, owner, item.id);
        for (const auto& p : *parameters) out.push_back(fmt::format("{}.{}", where, p.name));
    });
    for (auto& name : constant_names(system)) out.push_back(std::move(name));
    return out;
}

std::optional<Assignment> parse_assignment(const System& system, const Registry& registry,
                                           std::string_view text, std::string_view what,
                                           Diagnostics& diagnostics, Location at, Location value_at) {
    const expression::Context context{text, what, diagnostics, at, value_at};
    if (!value_at.file) value_at = at;
    if (auto constant = resolve_constant(system, text.substr(0, text.find('=')), context);
        constant && text.find('=') != text.npos) {
        constant->at = value_at;
        System changed = system;
        Diagnostics found;
        set_constant(changed, *constant, found);
        for (Diagnostic d : found.all()) {
            if (!d.where.file) d.message = fmt::format("{} '{}': {}", what, text, d.message);
            diagnostics.add(std::move(d));
        }
        if (found.failed()) return std::nullopt;
        constant->value = value_of(changed, *constant);
        return constant;
    }
    if (const auto name = trim(text.substr(0, text.find('=')));
        is_formula_name(name) && name.size() < text.size())
        if (const auto constants = constant_names(system); !constants.empty()) {
            context.error(0, fmt::format("there is no constant '{}'", name), suggest(name, constants));
            return std::nullopt;
        }
    const auto said = context.parsed(&expression::parse_assignment);
    if (!said) return std::nullopt;
    auto out = resolve(system, registry, *said, context);
    if (!out) return std::nullopt;
    const int errors_before = diagnostics.errors();
    const auto& value = said->value;
    const auto kind = out->parameter ? out->parameter->kind : ParameterKind::boolean;
    if (kind != ParameterKind::text && in_braces(value.text)) {
        out->value = formula_value(system, *out, value, context);
        return context.diagnostics.errors() == errors_before ? out : std::nullopt;
    }
    const auto parsed = parse_parameter(kind, value.text);
    if (!parsed) {
        context.error(value.at, fmt::format("'{}' is not {}", value.text, describe(kind)),
                      out->parameter ? out->parameter->doc : "");
        return std::nullopt;
    }
    const bool is_path = out->parameter && out->parameter->is_path;
    if (kind == ParameterKind::text && (is_path ? has_control(value.text) : has_odd_control(value.text))) {
        context.error(value.at, fmt::format("'{}' has a control character", value.text), "remove it");
        return std::nullopt;
    }
    out->value = *parsed;
    if (!out->parameter) return out;
    if (const auto& range = out->parameter->range; outside(*parsed, range))
        diagnostics.warning(value_at, fmt::format("{} '{}': outside the usual range {} to {}", what, text,
                                                  to_text(range->low), to_text(range->high)));
    if (is_path) out->value = resolved(value.text, value_at);
    return out;
}

std::optional<Assignment> find_item(const System& system, std::string_view where, std::string_view what,
                                    Diagnostics& diagnostics) {
    const expression::Context context{where, what, diagnostics};
    const auto owner = find_owner(system, Registry(), {std::string(where), 0}, context);
    if (!owner) return std::nullopt;
    return Assignment{owner->kind, owner->id, nullptr, {}, std::string(where), {}};
}

ParameterValue value_of(const System& system, const Assignment& a) {
    if (a.owner == Assignment::Owner::constant) return Constants(system).value_of(a.id).value_or(0);
    if (!a.parameter) return find_by(system.processes, a.id, &Process::id)->module_enabled;
    if (const auto* s = use_of(system, a).setting(a.parameter->name))
        if (auto value = parse_parameter(a.parameter->kind, s->in_force(a.parameter->kind)))
            return *std::move(value);
    return a.parameter->default_value;
}

void unset(System& system, const Assignment& a) {
    if (a.parameter)
        std::erase_if(use_of(system, a).settings, [&](const auto& s) { return s.name == a.parameter->name; });
    else
        find_by(system.processes, a.id, &Process::id)->module_enabled = true;
}

void move_files(System& system, const std::string& from, const std::string& to, const Registry& registry) {
    namespace fs = std::filesystem;
    const fs::path old_place = fs::absolute(from).parent_path(), new_place = fs::absolute(to).parent_path();
    if (fs::weakly_canonical(old_place) == fs::weakly_canonical(new_place)) return;
    const auto move = [&](std::string& path) {
        if (!path.empty() && fs::path(path).is_relative())
            path = fs::relative(old_place / path, new_place).generic_string();
    };
    for (auto& p : system.processes) {
        auto& written = p.linked() ? p.placeholder.front() : p;
        move(written.path);
        if (!p.linked())
            each_array(std::span(&p, 1), std::span<Connection>(), [&](auto& item) { move(item.file); });
        const ModuleType* type = written.module ? registry.module(written.module->type) : nullptr;
        if (!type) continue;
        for (auto& s : written.module->settings)
            for (const auto& parameter : type->parameters)
                if (parameter.is_path && parameter.name == s.name) move(s.value);
    }
    for (auto& c : system.connections)
        if (!c.linked)
            each_array(std::span<Process>(), std::span(&c, 1), [&](auto& item) { move(item.file); });
}

void set(System& system, const Assignment& a) {
    if (a.owner == Assignment::Owner::constant) {
        Diagnostics unread;  // parse_assignment() has reported what is wrong
        return set_constant(system, a, unread);
    }
    if (a.owner == Assignment::Owner::process && !a.parameter) {
        find_process(system, a.id)->module_enabled = std::get<bool>(a.value);
        return;
    }
    const bool as_written = !a.parameter->is_path;
    set_parameter(
        use_of(system, a), a.parameter->name,
        as_written ? std::string(trim(expression::split_assignment(a.text).value)) : to_text(a.value));
    if (as_written && a.text.ends_with('}')) compute(system);
}

System with(const System& system, const Assignment& assignment) {
    System out = system;
    set(out, assignment);
    return out;
}

void set(System& system, const Registry& registry, std::string_view assignment, Diagnostics& diagnostics,
         Location at, Location value_at) {
    const std::string_view what = at.file ? "set" : "--set";
    if (const auto a = parse_assignment(system, registry, assignment, what, diagnostics, std::move(at),
                                        std::move(value_at)))
        set(system, *a);
}

}  // namespace forage::model
