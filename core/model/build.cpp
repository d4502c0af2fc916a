#include "core/model/build.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <unordered_set>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/arrays.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"
#include "core/model/refused.h"

namespace forage::model {
namespace {

/// The ids of all items. They are views of the system's.
std::unordered_set<std::string_view> all_ids(const System& system) {
    std::unordered_set<std::string_view> ids{system.id};
    for (const auto& p : system.processes) {
        ids.insert(p.id);
        for (const auto& g : p.groups) ids.insert(g.id);
        for (const auto& c : p.canvas_comments) ids.insert(c.id);
    }
    for (const auto& c : system.connections) ids.insert(c.id);
    for (const auto& c : system.canvas_comments) ids.insert(c.id);
    return ids;
}

/// `id` if it is not in use, or a new id when it is empty.
std::string claim(const System& system, std::string id, const std::string& preferred) {
    if (id.empty()) return fresh_id(system, preferred);
    if (all_ids(system).contains(id)) throw std::invalid_argument(fmt::format("the id '{}' is taken", id));
    return id;
}

using IdSet = std::set<std::string, std::less<>>;

IdSet group_ids(const Process& p) {
    IdSet out;
    for (const auto& g : p.groups) out.insert(g.id);
    return out;
}

/// Unsets the cross references of a module to groups that are not to be kept.
template <class Keep>
void keep_references(Process& p, Keep keep) {
    if (!p.module) return;
    for (auto* references : {&p.module->inputs, &p.module->outputs})
        for (auto& r : *references)
            if (!keep(r.target)) r.target.clear();
}

void forget_groups(System& system, const IdSet& ids) {
    std::erase_if(system.connections,
                  [&](const Connection& c) { return ids.contains(c.source) || ids.contains(c.target); });
    for (auto& p : system.processes)
        keep_references(p, [&](const std::string& target) { return !ids.contains(target); });
}

/// Gives the ids of items, and all references to groups, the first prefix with which no id is in `system`:
/// `prefix`, or `further` with a number from 2. Returns it.
std::string add_free_prefix(const System& system, std::string prefix, std::string_view further,
                            std::span<Process> processes, std::span<Connection> connections,
                            std::span<CanvasComment> comments) {
    std::vector<std::string*> ids, references;
    for (auto& p : processes) {
        ids.push_back(&p.id);
        for (auto& g : p.groups) ids.push_back(&g.id);
        for (auto& c : p.canvas_comments) ids.push_back(&c.id);
        for (auto& f : p.phantoms) references.push_back(&f.group);
        for (auto& port : p.ports) references.push_back(&port.group);
        references.push_back(&p.within);
        if (p.module)
            for (auto* side : {&p.module->inputs, &p.module->outputs})
                for (auto& r : *side) references.push_back(&r.target);
    }
    for (auto& c : connections)
        ids.push_back(&c.id), references.push_back(&c.source), references.push_back(&c.target);
    for (auto& c : comments) ids.push_back(&c.id);
    const auto taken = all_ids(system);
    const auto clashes = [&] {
        return std::ranges::any_of(ids, [&](const auto* id) { return taken.contains(prefix + *id); });
    };
    for (int n = 2; clashes(); ++n) prefix = fmt::format(fmt::runtime(further), n);
    for (auto* id : ids) *id = prefix + *id;
    for (auto* reference : references)
        if (!reference->empty()) *reference = prefix + *reference;
    return prefix;
}

/// Adds the types of another system that a system lacks.
void take_over_types(System& system, System& other) {
    const auto take_over = [](auto& all, auto& more) {
        for (auto& type : more)
            if (!contains(all, type)) all.push_back(std::move(type));
    };
    take_over(system.neuron_types, other.neuron_types);
    take_over(system.synapse_types, other.synapse_types);
}

/// Throws for a linked process: its content is in its own file, so changes would be lost.
void refuse_linked(const Process& p) {
    if (p.linked())
        throw Refused(fmt::format("process '{}' is linked to '{}'", p.name, p.path),
                      "change it in its file, or import it, which makes it a part of this system");
}

}  // namespace

std::string fresh_id(const System& system, const std::string& preferred) {
    const auto taken = all_ids(system);
    std::string id = preferred;
    for (int n = 2; taken.contains(id); ++n) id = fmt::format("{}-{}", preferred, n);
    return id;
}

std::string add_process(System& system, std::string name, std::string id) {
    Process p;
    p.id = claim(system, std::move(id), "process");
    p.name = std::move(name);
    system.processes.push_back(std::move(p));
    return system.processes.back().id;
}

std::string add_group(System& system, std::string_view process, std::string name, int width, int height,
                      std::string neuron_type, std::string id) {
    Process& p = process_with(system, process);
    refuse_linked(p);
    Group g;
    g.id = claim(system, std::move(id), "group");
    g.name = std::move(name);
    g.topology = RectTopology{width, height};
    g.neuron.type = std::move(neuron_type);
    p.groups.push_back(std::move(g));
    return p.groups.back().id;
}

std::string add_connection(System& system, std::string_view source, std::string_view target, InputKind kind,
                           std::string synapse_type, std::string id) {
    for (const auto end : {source, target})
        if (!find_group(system, end)) no_item("group", end);
    Connection c;
    c.id = claim(system, std::move(id), "connection");
    c.name = fmt::format("{} to {}", find_group(system, source)->name, find_group(system, target)->name);
    c.source = source, c.target = target, c.kind = kind;
    c.synapse.emplace().type = std::move(synapse_type);
    c.line.emplace();
    system.connections.push_back(std::move(c));
    return system.connections.back().id;
}

std::string add_canvas_comment(System& system, std::string_view process, CanvasComment comment) {
    Process* p = process.empty() ? nullptr : &process_with(system, process);
    if (p) refuse_linked(*p);
    comment.id = claim(system, std::move(comment.id), "comment");
    auto& page = p ? p->canvas_comments : system.canvas_comments;
    page.push_back(std::move(comment));
    return page.back().id;
}

Process* find_process(System& system, std::string_view id) {
    return find_by(system.processes, id, &Process::id);
}

void no_item(std::string_view what, std::string_view id) {
    throw std::invalid_argument(fmt::format("there is no {} with the id '{}'", what, id));
}

Process& process_with(System& system, std::string_view id) {
    if (Process* p = find_process(system, id)) return *p;
    no_item("process", id);
}

Group* find_group(System& system, std::string_view id) {
    for (auto& p : system.processes)
        if (Group* g = find_by(p.groups, id, &Group::id)) return g;
    return nullptr;
}

Connection* find_connection(System& system, std::string_view id) {
    return find_by(system.connections, id, &Connection::id);
}

CanvasComment* find_canvas_comment(System& system, std::string_view id) {
    for (auto& p : system.processes)
        if (auto* c = find_by(p.canvas_comments, id, &CanvasComment::id)) return c;
    return find_by(system.canvas_comments, id, &CanvasComment::id);
}

void forget_phantoms(System& system) {
    const GroupIndex groups(system);
    std::set<std::pair<const Process*, std::string_view>> shown;
    for (const auto& c : system.connections) {
        const auto source = groups.find(c.source), target = groups.find(c.target);
        if (!source.group || !target.group) continue;
        shown.emplace(source.process, c.target), shown.emplace(target.process, c.source);
    }
    for (auto& p : system.processes) {
        const auto is_gone = [&](const Phantom& f) { return !shown.contains({&p, f.group}); };
        std::erase_if(p.phantoms, is_gone);
        for (auto& in_this_file : p.placeholder) std::erase_if(in_this_file.phantoms, is_gone);
    }
}

void set_parameter(TypeUse& use, std::string name, std::string value) {
    const auto it = std::ranges::find(use.settings, name, &Setting::name);
    if (it == use.settings.end())
        use.settings.push_back({std::move(name), std::move(value), {}, {}});
    else
        it->value = std::move(value), it->value_at = {};
}

void remove(System& system, std::string_view id) {
    const auto is_it = [id = std::string(id)](const auto& item) { return item.id == id; };
    if (std::erase_if(system.connections, is_it)) return forget_phantoms(system);
    if (std::erase_if(system.canvas_comments, is_it)) return;
    for (auto& p : system.processes) {
        if (find_by(p.canvas_comments, id, &CanvasComment::id)) {
            refuse_linked(p);
            std::erase_if(p.canvas_comments, is_it);
            return;
        }
        if (find_by(p.groups, id, &Group::id)) {
            refuse_linked(p);
            forget_groups(system, IdSet{std::string(id)});
            std::erase_if(p.groups, is_it);
            return forget_phantoms(system);
        }
    }
    const Process* process = find_process(system, id);
    if (!process) no_item("process, group, connection or comment", id);
    forget_groups(system, group_ids(*process));
    std::erase_if(system.processes, is_it);
    forget_phantoms(system);
}

void add_prefix(const std::string& prefix, std::span<Process> processes, std::span<Connection> connections) {
    add_free_prefix(System(), prefix, {}, processes, connections, {});
}

std::string make_ids_unique(const System& system, std::span<Process> processes,
                            std::span<Connection> connections) {
    IdSet groups;
    for (const auto& p : processes) groups.merge(group_ids(p));
    for (auto& c : connections) {
        if (!groups.contains(c.source) || !groups.contains(c.target))
            throw std::invalid_argument(fmt::format("connection '{}' leads out of the process", c.name));
        c.linked = false;
    }
    for (auto& p : processes) {
        std::erase_if(p.phantoms, [&](const Phantom& f) { return !groups.contains(f.group); });
        keep_references(p, [&](const std::string& target) { return groups.contains(target); });
    }
    return add_free_prefix(system, "CB1", "CB{}", processes, connections, {});
}

std::string import_process(System& system, ProcessFile file) {
    System content = system_of(std::move(file));
    embed_links(content);
    make_ids_unique(system, content.processes, content.connections);
    std::string id = content.processes.front().id;
    take_over_types(system, content);
    for (auto& p : content.processes) system.processes.push_back(std::move(p));
    for (auto& c : content.connections) system.connections.push_back(std::move(c));
    return id;
}

void join(System& system, System other) {
    embed_links(other);
    if (!agree(system.constants, other.constants)) write_out_formulas(other);
    for (auto& c : other.constants)
        if (!find_constant(system, c.name)) system.constants.push_back(std::move(c));
    take_over_types(system, other);
    add_free_prefix(system, "", "S{}_", other.processes, other.connections, other.canvas_comments);
    for (auto& p : other.processes) {
        p.name = free_name(system.processes, p.name);
        system.processes.push_back(std::move(p));
    }
    for (auto& c : other.connections) system.connections.push_back(std::move(c));
    for (auto& c : other.canvas_comments) system.canvas_comments.push_back(std::move(c));
}

ProcessFile extract_process(const System& system, std::string_view id) {
    const auto it = std::ranges::find(system.processes, id, &Process::id);
    if (it == system.processes.end()) no_item("process", id);
    ProcessFile out{*it, {}};
    out.process.path.clear();
    out.process.placeholder.clear();
    out.process.phantoms.clear();
    const auto groups = group_ids(*it);
    keep_references(out.process, [&](const std::string& target) { return groups.contains(target); });
    const auto open_port = [&](const std::string& group) {
        auto& ports = out.process.ports;
        if (groups.contains(group) && !contains(ports, group, &Port::group))
            ports.push_back({.name = group, .group = group, .at = {}, .name_at = {}, .group_at = {}});
    };
    for (const auto& c : system.connections)
        if (groups.contains(c.source) && groups.contains(c.target)) {
            out.connections.push_back(c);
            out.connections.back().linked = false;
        } else {
            open_port(c.source), open_port(c.target);
        }
    for (const auto& c : system.constants)  // on which its formulas may depend
        if (!contains(it->constants, c.name, &Constant::name)) out.process.constants.push_back(c);
    const auto copy_used = [](const auto& all, auto& to, auto is_used) {
        std::ranges::copy_if(all, std::back_inserter(to),
                             [&](const TypeDeclaration& type) { return is_used(type.name); });
    };
    copy_used(system.neuron_types, out.neuron_types, [&](const std::string& name) {
        return std::ranges::any_of(it->groups, [&](const Group& g) { return g.neuron.type == name; });
    });
    copy_used(system.synapse_types, out.synapse_types, [&](const std::string& name) {
        return std::ranges::any_of(out.connections,
                                   [&](const Connection& c) { return synapse_of(c).type == name; });
    });
    return out;
}

System system_of(ProcessFile file) {
    System out;
    out.name = file.process.name;
    out.processes.push_back(std::move(file.process));
    for (auto& p : file.parts) out.processes.push_back(std::move(p));
    out.connections = std::move(file.connections);
    out.neuron_types = std::move(file.neuron_types), out.synapse_types = std::move(file.synapse_types);
    return out;
}

void make_original(System& system, Diagnostics& diagnostics) {
    refuse_extensions(system, diagnostics);
    const auto is_part = [](const Process& p) { return p.linked() && !p.ports.empty(); };
    if (std::ranges::any_of(system.processes, is_part)) embed_links(system);
    complete(system.processes, system.connections);
    write_out_formulas(system);
}

void make_original(ProcessFile& file, Diagnostics& diagnostics) {
    System alone = system_of(std::move(file));
    compute(alone, diagnostics);
    make_original(alone, diagnostics);
    file = {.process = std::move(alone.processes.front()), .connections = std::move(alone.connections)};
}

void embed_links(System& system) {
    const auto depends_on_place = [](const Process& p) {
        return !p.within.empty() || std::ranges::any_of(p.constants, &Constant::given);
    };
    if (std::ranges::any_of(system.processes, depends_on_place)) settle_constants(system);
    for (auto& p : system.processes) p.path.clear(), p.placeholder.clear(), p.within.clear(), p.ports.clear();
    for (auto& c : system.connections) c.linked = false;
    for (auto* types : {&system.neuron_types, &system.synapse_types})
        for (auto& type : *types) type.linked = false;
}

void complete(std::span<Process> processes, std::span<Connection> connections) {
    const auto place = [](std::optional<Icon>& icon, int number) {
        if (!icon) icon = Icon{20 + number % 6 * 100, 20 + number / 6 * 90, 50, 50};
    };
    int process = 0;
    for (Process& p : processes) {
        place(p.icon, process++);
        if (p.linked()) p.placeholder.front().icon = p.icon;
        int group = 0;
        for (Group& g : p.groups) place(g.icon, group++), g.terse = false;
    }
    for (Connection& c : connections) {
        c.terse = c.terse_synapse = false;
        if (!c.line) c.line.emplace();
    }
}

void shorten(std::span<Process> processes, std::span<Connection> connections) {
    for (Process& p : processes)
        for (Group& g : p.groups) g.terse = true;
    for (Connection& c : connections) c.terse = c.terse_synapse = true;
}

void rename(System& system, std::string_view id, std::string name) {
    if (trim(name).empty()) throw Refused("a name cannot be empty", "write at least one letter or digit");
    for (auto& p : system.processes) {
        auto* g = p.id == id ? nullptr : find_by(p.groups, id, &Group::id);
        if (p.id != id && !g) continue;
        refuse_linked(p);
        (g ? g->name : p.name) = std::move(name);
        return;
    }
    auto* c = find_connection(system, id);
    if (!c) no_item("process, group or connection", id);
    if (c->linked)
        throw Refused(fmt::format("connection '{}' is in the file of a linked process", trim(c->name)),
                      "change it in that file");
    c->name = std::move(name);
}

}  // namespace forage::model
