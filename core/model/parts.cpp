#include "core/model/parts.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/build.h"
#include "core/model/lookup.h"
#include "core/model/refused.h"

namespace forage::model {
namespace {

/// Calls f(name, group) with the ports of linked processes.
template <class F>
void each_port(const System& system, F f) {
    for (const auto& p : system.processes)
        if (p.linked() && p.within.empty())
            for (const auto& port : p.ports)
                if (!port.group.empty()) f(p.id + "." + port.name, port.group);
}

/// Calls f(id) with the ids of the groups and connections of a process file.
template <class F>
void each_id(ProcessFile& file, F f) {
    for (auto& g : file.process.groups) f(g.id);
    for (auto& c : file.process.canvas_comments) f(c.id);
    for (auto& c : file.connections) f(c.id);
}

/// Calls f(id) with the references to groups of a process.
template <class F>
void each_reference(Process& p, F f) {
    for (auto& phantom : p.phantoms) f(phantom.group);
    if (!p.module) return;
    for (auto* side : {&p.module->inputs, &p.module->outputs})
        for (auto& r : *side) f(r.target);
}

void replace_id(const Names& names, std::string& id) {
    if (const auto it = names.find(id); it != names.end()) id = it->second;
}

/// Throws Refused for a process that cannot be a part.
void refuse_as_part(const System& system, const Process& p) {
    const std::string name(trim(p.name));
    if (p.linked() || !p.within.empty())
        throw Refused(fmt::format("process '{}' is in a file already", name), "dissolve it first");
    if (p.groups.empty())
        throw Refused(fmt::format("process '{}' has no groups", name), "a part has groups to connect to");
    Process copy = p;
    copy.phantoms.clear();
    const GroupIndex groups(system);
    each_reference(copy, [&](const std::string& target) {
        if (const auto found = groups.find(target); found.group && found.process != &p)
            throw Refused(
                fmt::format("the module of '{}' has the group '{}' of another process", name,
                            path(system, *found.process, *found.group)),
                "a part has all groups of its module: move the group into the process, or connect a "
                "group of the process with it");
    });
    for (const auto& other : system.processes)
        for (const auto& use : other.placeholder)
            for (const auto& port : use.ports)
                if (groups.find(port.group).process == &p)
                    throw Refused(fmt::format("process '{}' gives the group '{}' of '{}' to its part",
                                              trim(other.name), port.group, name),
                                  "its id would change: move the group into another process");
}

/// The opposite of name_use(): takes the name of the process from names, and `prefix` from the ids of a file,
/// where they have it, unless two items would then have one id. Returns the new ids by the old ones.
Names without_prefix(ProcessFile& file, const std::string& prefix) {
    const std::string name = std::string(trim(file.process.name)) + ".";
    Names names;
    std::set<std::string> known{file.process.id};
    bool unique = true;
    each_id(file, [&](const std::string& id) {
        const bool has_it = id.size() > prefix.size() && id.starts_with(prefix);
        unique = known.insert(names[id] = has_it ? id.substr(prefix.size()) : id).second && unique;
    });
    if (!unique)
        for (auto& [before, after] : names) after = before;
    each_id(file, [&](std::string& id) { replace_id(names, id); });
    each_reference(file.process, [&](std::string& id) { replace_id(names, id); });
    for (auto& port : file.process.ports) {
        if (port.name == port.group) replace_id(names, port.name);
        replace_id(names, port.group);
    }
    for (auto& c : file.connections) {
        replace_id(names, c.source), replace_id(names, c.target);
        if (c.name.starts_with(name)) c.name.erase(0, name.size());
    }
    return names;
}

/// Removes the types that only the file of a part needs from now on.
void leave_types(std::vector<TypeDeclaration>& all, const std::vector<TypeDeclaration>& in_file,
                 const std::set<std::string_view>& used) {
    std::erase_if(all, [&](const TypeDeclaration& type) {
        return !type.linked && !used.contains(type.name) &&
               contains(in_file, type.name, &TypeDeclaration::name);
    });
}

}  // namespace

const Process* outer(const System& system, const Process& process) {
    if (process.within.empty()) return nullptr;
    return find_by(system.processes, process.within, &Process::id);
}

bool is_open_port(const System& system, std::string_view name) {
    return std::ranges::any_of(system.processes, [&](const Process& p) {
        return !p.linked() && std::ranges::any_of(p.ports, [&](const Port& port) {
            return port.group.empty() && port.name == name;
        });
    });
}

void name_use(System& content, const Process& place) {
    add_prefix(place.id + ".", content.processes, content.connections);
    for (auto& p : content.processes) {
        p.name = std::string(trim(place.name)) + "." + std::string(trim(p.name));
        if (p.within.empty()) p.within = place.id;
    }
    for (auto& c : content.connections)
        c.name = std::string(trim(place.name)) + "." + std::string(trim(c.name));
    Process& own = content.processes.front();
    own.id = place.id, own.name = place.name, own.within.clear();
    if (!place.module_enabled) own.module_enabled = false;
}

void give(Process& place, const Constant& constant) {
    auto it = std::ranges::find(place.constants, constant.name, &Constant::name);
    if (it == place.constants.end()) it = place.constants.insert(it, Constant());
    it->name = constant.name, it->value = constant.value;
}

Names groups_by_port(const System& system) {
    Names out;
    each_port(system, [&](const std::string& name, const std::string& group) { out.emplace(name, group); });
    return out;
}

Names ports_by_group(const System& system) {
    Names out;
    each_port(system, [&](const std::string& name, const std::string& group) { out.emplace(group, name); });
    return out;
}

Connection renamed(const Names& names, Connection c) {
    for (auto* end : {&c.source, &c.target})
        if (const auto it = names.find(*end); it != names.end()) *end = it->second;
    return c;
}

std::string use_part(System& system, const ProcessFile& file, const std::string& path, std::string name,
                     std::string id) {
    if (trim(name).empty()) name = free_name(system.processes, std::string(trim(file.process.name)));
    if (id.empty()) id = fresh_id(system, file.process.id);
    auto made = add_process(system, std::move(name), std::move(id));
    find_process(system, made)->path = path;
    return made;
}

MadePart make_part(System& system, std::string_view id, const std::string& path) {
    Process& before = process_with(system, id);
    refuse_as_part(system, before);
    MadePart out{extract_process(system, id), {}};
    auto& part = out.file.process;
    for (auto* types : {&out.file.neuron_types, &out.file.synapse_types})
        for (auto& type : *types) type.linked = false;
    if (part.ports.empty())
        for (const auto& g : part.groups)
            part.ports.push_back({.name = g.id, .group = g.id, .at = {}, .name_at = {}, .group_at = {}});

    Process use;
    use.id = before.id, use.name = before.name, use.icon = before.icon, use.path = path;
    use.comments = before.comments, use.phantoms = before.phantoms;
    for (const auto& c : part.constants)
        if (!contains(before.constants, c.name, &Constant::name)) {
            Constant given;
            given.name = c.name, given.value = "{" + c.name + "}";
            give(use, given);
        }

    // In the system, the ids of the file begin with that of the process that uses it.
    const std::string prefix = before.id + ".";
    const Names shortened = without_prefix(out.file, prefix);
    Names names, ends;
    for (const auto& [was, is] : shortened) {
        names[was] = prefix + is;
        const bool is_comment = contains(part.canvas_comments, is, &CanvasComment::id);
        if (was != prefix + is && !is_comment) out.renamed.push_back(prefix + is);
    }
    for (const auto& port : part.ports)
        for (const auto& [was, is] : shortened)
            if (is == port.group) ends.emplace(was, prefix + port.name);
    before = std::move(use);
    std::erase_if(system.connections, [&](const Connection& c) { return shortened.contains(c.id); });
    for (auto& c : system.connections)
        if (!c.linked) c = renamed(ends, std::move(c));
    for (auto& p : system.processes)
        if (!p.linked()) each_reference(p, [&](std::string& target) { replace_id(names, target); });

    std::set<std::string_view> neurons, synapses;
    for (const auto& p : system.processes)
        if (!p.linked())
            for (const auto& g : p.groups) neurons.insert(g.neuron.type);
    for (const auto& c : system.connections)
        if (!c.linked) synapses.insert(synapse_of(c).type);
    leave_types(system.neuron_types, out.file.neuron_types, neurons);
    leave_types(system.synapse_types, out.file.synapse_types, synapses);
    return out;
}

void dissolve(System& system, std::string_view id) {
    const Process& use = process_with(system, id);
    if (!use.within.empty())
        throw Refused(fmt::format("process '{}' is in the file of another process", trim(use.name)),
                      "dissolve that one");
    if (!use.linked())
        throw Refused(fmt::format("process '{}' has no file of its own", trim(use.name)),
                      "only a process that uses a file can be dissolved");
    System embedded = system;
    embed_links(embedded);
    const GroupIndex groups(system);
    const auto is_in_use = [&](const Process* p) {
        while (p && p->id != id) p = outer(system, *p);
        return p != nullptr;
    };
    std::set<std::string_view> types;
    std::vector<std::size_t> processes, connections;
    for (std::size_t i = 0; i < system.processes.size(); ++i)
        if (is_in_use(&system.processes[i])) {
            processes.push_back(i);
            for (const auto& g : system.processes[i].groups) types.insert(g.neuron.type);
        }
    for (std::size_t i = 0; i < system.connections.size(); ++i)
        if (const auto& c = system.connections[i]; c.linked && is_in_use(groups.find(c.source).process) &&
                                                   is_in_use(groups.find(c.target).process)) {
            connections.push_back(i);
            types.insert(synapse_of(c).type);
        }
    for (auto* declared : {&system.neuron_types, &system.synapse_types})
        for (auto& type : *declared)
            if (types.contains(type.name)) type.linked = false;
    for (const auto i : processes) system.processes[i] = std::move(embedded.processes[i]);
    for (const auto i : connections) system.connections[i] = std::move(embedded.connections[i]);
}

}  // namespace forage::model
