#include "core/model/operations.h"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/lookup.h"

namespace forage::model {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument(message); }
[[noreturn]] void missing(std::string_view what, std::string_view id) {
    refuse(fmt::format("there is no {} with the id '{}'", what, id));
}

void refuse_edit(const Process& p) {
    if (p.linked())
        refuse(fmt::format("process '{}' is linked to '{}': its content is edited in that file", trim(p.name),
                           p.path));
}

Process& process_of(System& system, std::string_view id) {
    Process* p = find_process(system, id);
    if (!p) missing("process", id);
    refuse_edit(*p);
    return *p;
}
Group& group_of(System& system, std::string_view id) {
    for (auto& p : system.processes)
        for (auto& g : p.groups)
            if (g.id == id) return refuse_edit(p), g;
    missing("group", id);
}
Connection& connection_of(System& system, std::string_view id) {
    Connection* c = find_connection(system, id);
    if (!c) missing("connection", id);
    if (c->linked) refuse(fmt::format("connection '{}' is in the file of a linked process", trim(c->name)));
    return *c;
}
void require_group(System& system, std::string_view id) {
    if (!find_group(system, id)) missing("group", id);
}

void move(std::optional<Icon>& icon, int x, int y) {
    if (!icon) icon.emplace();
    icon->x = x, icon->y = y;
}

/// The use of a type in a group, connection or process.
TypeUse& use_of(System& system, std::string_view id) {
    if (find_group(system, id)) return group_of(system, id).neuron;
    if (find_connection(system, id)) {
        auto& c = connection_of(system, id);
        if (!c.synapse) refuse(fmt::format("connection '{}' has no synapse", trim(c.name)));
        return *c.synapse;
    }
    if (find_process(system, id)) {
        auto& p = process_of(system, id);
        if (!p.module) refuse(fmt::format("process '{}' has no module", trim(p.name)));
        return *p.module;
    }
    missing("group, connection or process", id);
}

/// Removes the settings that a type does not have.
template <class Type>
void change_type(TypeUse& use, const Type* type, const std::string& name, const char* what) {
    if (!type) refuse(fmt::format("there is no {} type '{}'", what, name));
    use.type = name;
    std::erase_if(use.settings, [&](const Setting& s) {
        return std::ranges::none_of(type->parameters, [&](const Parameter& p) { return p.name == s.name; });
    });
}
template <class Ports>
void keep_ports(std::vector<CrossReference>& references, const Ports& ports) {
    std::erase_if(references, [&](const CrossReference& r) {
        return std::ranges::none_of(ports, [&](const auto& p) { return p.name == r.name; });
    });
}

void set_references(std::vector<CrossReference>& references,
                    const std::map<std::string, std::string>& wanted) {
    for (const auto& [name, target] : wanted) {
        const auto it = std::ranges::find(references, name, &CrossReference::name);
        if (it == references.end())
            references.push_back({name, target, {}});
        else
            it->target = target;
    }
}

/// `name`, or `name` with a number, so that it is not among `taken`.
template <class Items>
std::string free_name(const Items& taken, const std::string& name) {
    const auto is_taken = [&](std::string_view wanted) {
        return std::ranges::any_of(taken, [&](const auto& item) { return trim(item.name) == trim(wanted); });
    };
    std::string out = name;
    for (int n = 2; is_taken(out); ++n) out = fmt::format("{} {}", trim(name), n);
    return out;
}

}  // namespace

const TypeUse* find_use(const System& system, std::string_view id) {
    for (const auto& p : system.processes) {
        if (p.id == id) return p.module ? &*p.module : nullptr;
        for (const auto& g : p.groups)
            if (g.id == id) return &g.neuron;
    }
    for (const auto& c : system.connections)
        if (c.id == id) return c.synapse ? &*c.synapse : nullptr;
    return nullptr;
}

void place(System& system, std::string_view id, int x, int y) {
    if (Process* p = find_process(system, id)) {
        move(p->icon, x, y);
        if (p->linked()) move(p->placeholder.front().icon, x, y);
    } else if (find_group(system, id)) {
        move(group_of(system, id).icon, x, y);
    } else {
        missing("process or group", id);
    }
}

void set_line(System& system, std::string_view id, LineChange change) {
    auto& c = connection_of(system, id);
    for (const auto& anchor : {change.source_anchor, change.target_anchor})
        if (anchor && (*anchor < 0 || *anchor > 15)) refuse("an anchor is a number from 0 to 15");
    if (!c.line) c.line.emplace();
    if (change.source_anchor) c.line->source_anchor = *change.source_anchor;
    if (change.target_anchor) c.line->target_anchor = *change.target_anchor;
    if (change.vertices) c.line->vertices = *std::move(change.vertices);
}

void reroute(System& system, std::string_view id, std::string_view source, std::string_view target) {
    auto& c = connection_of(system, id);
    for (const auto end : {source, target})
        if (!end.empty()) require_group(system, end);
    if (!source.empty()) c.source = source;
    if (!target.empty()) c.target = target;
}

void set_color(System& system, std::string_view id, std::string color) {
    if (find_process(system, id))
        process_of(system, id).color = std::move(color);
    else
        group_of(system, id).color = std::move(color);
}

void set_note(System& system, std::string_view id, std::string text) {
    auto note = text.empty() ? std::nullopt : std::optional(std::move(text));
    if (id == system.id)
        system.note = std::move(note);
    else if (find_process(system, id))
        process_of(system, id).note = std::move(note);
    else if (find_group(system, id))
        group_of(system, id).note = std::move(note);
    else
        connection_of(system, id).note = std::move(note);
}

void set_kind(System& system, std::string_view id, InputKind kind) { connection_of(system, id).kind = kind; }

void set_enabled(System& system, std::string_view id, bool enabled) {
    process_of(system, id).module_enabled = enabled;
}

void set_type(System& system, const Registry& registry, std::string_view id, Part part,
              const std::string& type) {
    if (part == Part::neuron) {
        change_type(group_of(system, id).neuron, registry.neuron(type), type, "neuron");
    } else if (part == Part::synapse) {
        auto& c = connection_of(system, id);
        const auto* found = registry.synapse(type);
        SynapseUse use = c.synapse.value_or(SynapseUse());
        change_type(use, found, type, "synapse");
        keep_ports(use.feedback, found->feedback);
        c.synapse = std::move(use);
    } else {
        auto& p = process_of(system, id);
        if (type.empty()) return p.module.reset();
        const auto* found = registry.module(type);
        ModuleUse use = p.module.value_or(ModuleUse());
        change_type(use, found, type, "module");
        if (!found->any_ports) keep_ports(use.inputs, found->ports), keep_ports(use.outputs, found->ports);
        p.module = std::move(use);
    }
}

void set_parameter(System& system, std::string_view id, const std::string& name,
                   const std::optional<std::string>& value) {
    TypeUse& use = use_of(system, id);
    if (value)
        set_parameter(use, name, *value);
    else
        std::erase_if(use.settings, [&](const Setting& s) { return s.name == name; });
}

void set_topology(System& system, std::string_view id, Topology topology) {
    group_of(system, id).topology = std::move(topology);
}
void set_pattern(System& system, std::string_view id, Pattern pattern) {
    connection_of(system, id).pattern = std::move(pattern);
}
void set_arborization(System& system, std::string_view id, Arborization arborization) {
    connection_of(system, id).arborization = std::move(arborization);
}
void set_attenuation(System& system, std::string_view id, DistanceFunction function) {
    connection_of(system, id).attenuation = std::move(function);
}
void set_delay(System& system, std::string_view id, DistanceFunction function) {
    connection_of(system, id).delay = std::move(function);
}

void set_ports(System& system, std::string_view id, const std::map<std::string, std::string>& inputs,
               const std::map<std::string, std::string>& outputs) {
    auto& p = process_of(system, id);
    if (!p.module) refuse(fmt::format("process '{}' has no module", trim(p.name)));
    for (const auto* ports : {&inputs, &outputs})
        for (const auto& [name, group] : *ports)
            if (!group.empty()) require_group(system, group);
    set_references(p.module->inputs, inputs);
    set_references(p.module->outputs, outputs);
}

void set_feedback(System& system, std::string_view id, const std::map<std::string, std::string>& states) {
    auto& c = connection_of(system, id);
    if (!c.synapse) refuse(fmt::format("connection '{}' has no synapse", trim(c.name)));
    set_references(c.synapse->feedback, states);
}

System copy(const System& system, std::span<const std::string> ids) {
    const std::set<std::string_view> wanted(ids.begin(), ids.end());
    std::set<std::string_view> groups, found;
    System out;
    out.id = out.name = clipboard_process;
    Process loose;
    loose.id = loose.name = clipboard_process;
    for (const auto& p : system.processes) {
        const bool whole = wanted.contains(p.id);
        if (whole) {
            found.insert(p.id);
            out.processes.push_back(p);
            out.processes.back().placeholder.clear();
            out.processes.back().path.clear();
        }
        for (const auto& g : p.groups) {
            if (!whole && !wanted.contains(g.id)) continue;
            groups.insert(g.id), found.insert(g.id);
            if (!whole) loose.groups.push_back(g);
        }
    }
    for (const auto& c : system.connections) {
        if (wanted.contains(c.id)) found.insert(c.id);
        if (!groups.contains(c.source) || !groups.contains(c.target)) continue;
        out.connections.push_back(c);
        out.connections.back().linked = false;
    }
    for (const auto& id : wanted)
        if (!found.contains(id)) missing("process, group or connection", id);
    if (!loose.groups.empty()) out.processes.push_back(std::move(loose));
    return out;
}

std::vector<std::string> paste(System& system, System content, std::string_view process, int x, int y) {
    embed_links(content);
    const auto loose = std::ranges::find(content.processes, clipboard_process, &Process::id);
    Process* target = nullptr;
    if (loose != content.processes.end()) {
        target = find_process(system, process);
        if (!target) missing("process", process);
        refuse_edit(*target);
    }
    const std::string prefix = make_ids_unique(system, content.processes, content.connections);
    const std::string loose_id = prefix + std::string(clipboard_process);

    int left = std::numeric_limits<int>::max(), top = left;
    const auto look = [&](const std::optional<Icon>& icon) {
        if (icon) left = std::min(left, icon->x), top = std::min(top, icon->y);
    };
    for (const auto& p : content.processes)
        if (p.id == loose_id)
            for (const auto& g : p.groups) look(g.icon);
        else
            look(p.icon);
    if (left == std::numeric_limits<int>::max()) left = x, top = y;  // nothing has a place
    const auto shift = [&](std::optional<Icon>& icon) {
        if (icon) icon->x += x - left, icon->y += y - top;
    };
    std::vector<std::string> ids;
    std::set<std::string_view> shifted;  // groups whose connections move with them
    for (auto& p : content.processes) {
        if (p.id != loose_id) {
            shift(p.icon);
            p.name = free_name(system.processes, p.name);
            ids.push_back(p.id);
            system.processes.push_back(std::move(p));
            continue;
        }
        target = find_process(system, process);  // adding processes may have moved it
        for (auto& g : p.groups) {
            shift(g.icon);
            g.name = free_name(target->groups, g.name);
            ids.push_back(g.id);
            target->groups.push_back(std::move(g));
        }
    }
    if (target) {
        target = find_process(system, process);  // processes may have been added after its groups
        for (const auto& g : target->groups) shifted.insert(g.id);
    }
    for (auto& c : content.connections) {
        if (c.line && shifted.contains(c.source) && shifted.contains(c.target))
            for (Point& v : c.line->vertices) v.x += x - left, v.y += y - top;
        ids.push_back(c.id);
        system.connections.push_back(std::move(c));
    }
    return ids;
}

}  // namespace forage::model
