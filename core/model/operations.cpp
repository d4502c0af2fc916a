#include "core/model/operations.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"

namespace forage::model {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument(message); }

void refuse_edit(const Process& p) {
    if (p.linked())
        refuse(fmt::format("process '{}' is linked to '{}': its content is edited in that file", trim(p.name),
                           p.path));
}

void require_group(System& system, std::string_view id) {
    if (!find_group(system, id)) no_item("group", id);
}

void move(std::optional<Icon>& icon, int x, int y) {
    if (!icon) icon.emplace();
    icon->x = x, icon->y = y;
}

/// The use of a type in a group, connection or process.
TypeUse& use_of(System& system, std::string_view id) {
    if (find_group(system, id)) return editable_group(system, id).neuron;
    if (find_connection(system, id)) {
        auto& c = editable_connection(system, id);
        if (!c.synapse) refuse(fmt::format("connection '{}' has no synapse", trim(c.name)));
        return *c.synapse;
    }
    if (find_process(system, id)) {
        auto& p = editable_process(system, id);
        if (!p.module) refuse(fmt::format("process '{}' has no module", trim(p.name)));
        return *p.module;
    }
    no_item("group, connection or process", id);
}

/// Removes the settings and the initial values that a type does not have.
template <class Type>
void change_type(TypeUse& use, const Type* type, const std::string& name, const char* what) {
    if (!type) refuse(fmt::format("there is no {} type '{}'", what, name));
    use.type = name;
    std::erase_if(use.settings, [&](const Setting& s) {
        return std::ranges::none_of(type->parameters, [&](const Parameter& p) { return p.name == s.name; });
    });
    if constexpr (requires { type->states; })
        std::erase_if(use.initial, [&](const Initial& i) {
            return std::ranges::none_of(type->states, [&](const auto& s) { return s.name == i.state; });
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

}  // namespace

Process& editable_process(System& system, std::string_view id) {
    Process& p = process_with(system, id);
    refuse_edit(p);
    return p;
}

Group& editable_group(System& system, std::string_view id) {
    for (auto& p : system.processes)
        for (auto& g : p.groups)
            if (g.id == id) return refuse_edit(p), g;
    no_item("group", id);
}

Connection& editable_connection(System& system, std::string_view id) {
    Connection* c = find_connection(system, id);
    if (!c) no_item("connection", id);
    if (c->linked) refuse(fmt::format("connection '{}' is in the file of a linked process", trim(c->name)));
    return *c;
}

std::string name_of(const System& system, std::string_view id) {
    for (const auto& p : system.processes) {
        if (p.id == id) return std::string(trim(p.name));
        for (const auto& g : p.groups)
            if (g.id == id) return path(system, p, g);
    }
    for (const auto& c : system.connections)
        if (c.id == id) return std::string(trim(c.name));
    return {};
}

void place(System& system, std::string_view id, int x, int y) {
    if (Process* p = find_process(system, id)) {
        move(p->icon, x, y);
        if (p->linked()) move(p->placeholder.front().icon, x, y);
    } else if (find_group(system, id)) {
        move(editable_group(system, id).icon, x, y);
    } else if (find_canvas_comment(system, id)) {
        set_comment(system, id, {.x = x, .y = y});
    } else {
        no_item("process, group or comment", id);
    }
}

void place_phantom(System& system, std::string_view process, std::string_view group, int x, int y) {
    Process& p = process_with(system, process);
    require_group(system, group);
    if (std::ranges::any_of(p.groups, [&](const Group& g) { return g.id == group; }))
        refuse(fmt::format("the group '{}' is in this process", group));
    const auto in = [&](std::vector<Phantom>& all) {
        const auto it = std::ranges::find(all, group, &Phantom::group);
        if (it == all.end())
            all.push_back({std::string(group), x, y});
        else
            it->x = x, it->y = y;
    };
    in(p.phantoms);
    if (p.linked()) in(p.placeholder.front().phantoms);  // like its icon
}

void set_line(System& system, std::string_view id, LineChange change) {
    auto& c = editable_connection(system, id);
    for (const auto& anchor : {change.source_anchor, change.target_anchor})
        if (anchor && (*anchor < 0 || *anchor > 15)) refuse("an anchor is a number from 0 to 15");
    if (!c.line) c.line.emplace();
    if (change.source_anchor) c.line->source_anchor = *change.source_anchor;
    if (change.target_anchor) c.line->target_anchor = *change.target_anchor;
    if (change.vertices) c.line->vertices = *std::move(change.vertices);
    if (change.source_vertices) c.line->source_vertices = *std::move(change.source_vertices);
    if (change.target_vertices) c.line->target_vertices = *std::move(change.target_vertices);
}

void reroute(System& system, std::string_view id, std::string_view source, std::string_view target) {
    auto& c = editable_connection(system, id);
    for (const auto end : {source, target})
        if (!end.empty()) require_group(system, end);
    const GroupIndex groups(system);
    const auto pages = [&] {
        return std::pair(groups.find(c.source).process, groups.find(c.target).process);
    };
    const auto before = pages();
    if (!source.empty()) c.source = source;
    if (!target.empty()) c.target = target;
    const auto now = pages();
    if (!c.line || now == before) return;
    const bool within = now.first == now.second;
    c.line->vertices.clear();
    if (within || now.first != before.first) c.line->source_vertices.clear();
    if (within || now.second != before.second) c.line->target_vertices.clear();
}

void set_comment(System& system, std::string_view id, CommentChange change) {
    for (auto& p : system.processes)
        if (std::ranges::any_of(p.canvas_comments, [&](const auto& c) { return c.id == id; })) refuse_edit(p);
    CanvasComment* c = find_canvas_comment(system, id);
    if (!c) no_item("comment", id);
    for (const auto& side : {change.width, change.height})
        if (side && *side < 1) refuse("a comment is at least 1 wide and high");
    const auto no_text = [](unsigned char b) { return b < ' ' && b != '\t' && b != '\n' && b != '\r'; };
    if (change.text && std::ranges::any_of(*change.text, no_text))
        refuse("a comment cannot hold control characters, as XML has none");
    if (change.text) c->text = *std::move(change.text);
    if (change.color) c->color = *std::move(change.color);
    c->box = {change.x.value_or(c->box.x), change.y.value_or(c->box.y), change.width.value_or(c->box.width),
              change.height.value_or(c->box.height)};
}

void set_color(System& system, std::string_view id, std::string color) {
    if (find_process(system, id))
        editable_process(system, id).color = std::move(color);
    else if (find_canvas_comment(system, id))
        set_comment(system, id, {.color = std::move(color)});
    else
        editable_group(system, id).color = std::move(color);
}

void set_note(System& system, std::string_view id, std::string text) {
    auto note = text.empty() ? std::nullopt : std::optional(std::move(text));
    if (id == system.id)
        system.note = std::move(note);
    else if (find_process(system, id))
        editable_process(system, id).note = std::move(note);
    else if (find_group(system, id))
        editable_group(system, id).note = std::move(note);
    else
        editable_connection(system, id).note = std::move(note);
}

void set_type(System& system, const Registry& registry, std::string_view id, Part part,
              const std::string& type) {
    if (part == Part::neuron) {
        change_type(editable_group(system, id).neuron, registry.neuron(type), type, "neuron");
    } else if (part == Part::synapse) {
        auto& c = editable_connection(system, id);
        const auto* found = registry.synapse(type);
        SynapseUse use = c.synapse.value_or(SynapseUse());
        change_type(use, found, type, "synapse");
        keep_ports(use.feedback, found->feedback);
        c.synapse = std::move(use);
    } else {
        auto& p = editable_process(system, id);
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

void set_ports(System& system, std::string_view id, const std::map<std::string, std::string>& inputs,
               const std::map<std::string, std::string>& outputs) {
    auto& p = editable_process(system, id);
    if (!p.module) refuse(fmt::format("process '{}' has no module", trim(p.name)));
    for (const auto* ports : {&inputs, &outputs})
        for (const auto& [name, group] : *ports)
            if (!group.empty()) require_group(system, group);
    set_references(p.module->inputs, inputs);
    set_references(p.module->outputs, outputs);
}

void set_feedback(System& system, std::string_view id, const std::map<std::string, std::string>& states) {
    auto& c = editable_connection(system, id);
    if (!c.synapse) refuse(fmt::format("connection '{}' has no synapse", trim(c.name)));
    set_references(c.synapse->feedback, states);
}

System copy(const System& system, std::span<const std::string> ids, Between connections) {
    const std::set<std::string_view> wanted(ids.begin(), ids.end());
    std::set<std::string_view> groups, found;
    bool one_scope = true;  // whether the same constants hold in all loose groups
    System out;
    out.id = out.name = clipboard_process;
    out.cycles_per_second = system.cycles_per_second, out.constants = system.constants;
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
            if (whole) continue;
            if (loose.groups.empty()) loose.constants = p.constants;
            one_scope = one_scope && loose.constants == p.constants;
            loose.groups.push_back(g);
        }
        for (const auto& c : p.canvas_comments)
            if (wanted.contains(c.id)) {
                found.insert(c.id);
                if (!whole) loose.canvas_comments.push_back(c);
            }
    }
    for (const auto& c : system.canvas_comments)
        if (wanted.contains(c.id)) found.insert(c.id), out.canvas_comments.push_back(c);
    const GroupIndex index(system);
    for (const auto& c : system.connections) {
        if (wanted.contains(c.id)) found.insert(c.id);
        if (!groups.contains(c.source) || !groups.contains(c.target)) continue;
        if (connections == Between::named && !wanted.contains(c.id)) continue;
        out.connections.push_back(c);
        out.connections.back().linked = false;
        const auto *from = index.find(c.source).process, *to = index.find(c.target).process;
        // A loose group leaves its page, and with it what a line between processes has there.
        if (c.line && from != to && !(wanted.contains(from->id) && wanted.contains(to->id))) {
            auto& line = *out.connections.back().line;
            line.vertices.clear(), line.source_vertices.clear(), line.target_vertices.clear();
        }
    }
    for (const auto& id : wanted)
        if (!found.contains(id)) no_item("process, group, connection or comment", id);
    if (!loose.groups.empty() || !loose.canvas_comments.empty()) out.processes.push_back(std::move(loose));
    if (!one_scope) write_out_formulas(out);
    return out;
}

std::vector<std::string> paste(System& system, System content, std::string_view process, int x, int y) {
    embed_links(content);
    const auto is_loose = [](const Process& p) { return p.id == clipboard_process; };
    std::vector<CanvasComment> comments;  // that come without a process
    bool groups = false;
    for (auto& p : content.processes)
        if (is_loose(p)) comments = std::exchange(p.canvas_comments, {}), groups = !p.groups.empty();
    if (!groups) std::erase_if(content.processes, is_loose);
    const bool whole = content.processes.size() > (groups ? 1u : 0u);
    if (!whole) std::ranges::move(std::exchange(content.canvas_comments, {}), std::back_inserter(comments));
    if (groups || (!comments.empty() && !process.empty())) refuse_edit(process_with(system, process));
    // Formulas stay where they mean the same.
    bool same_scope = has_all(system.constants, content.constants);
    for (const auto& p : content.processes)
        if (is_loose(p)) same_scope = same_scope && find_process(system, process)->constants == p.constants;
    if (!same_scope) write_out_formulas(content);
    const std::string prefix = make_ids_unique(system, content.processes, content.connections);
    const std::string loose_id = prefix + std::string(clipboard_process);

    int left = std::numeric_limits<int>::max(), top = left;
    const auto look = [&](const Icon& icon) { left = std::min(left, icon.x), top = std::min(top, icon.y); };
    for (const auto& p : content.processes)
        if (p.id == loose_id) {
            for (const auto& g : p.groups)
                if (g.icon) look(*g.icon);
        } else if (p.icon) {
            look(*p.icon);
        }
    for (const auto* all : {&comments, &content.canvas_comments})
        for (const auto& c : *all) look(c.box);
    if (left == std::numeric_limits<int>::max()) left = x, top = y;  // nothing has a place
    const auto shift = [&](auto& at) {
        const auto within = [](int v) { return std::clamp(v, -farthest_coordinate, farthest_coordinate); };
        at.x = within(at.x + x - left), at.y = within(at.y + y - top);
    };
    std::vector<std::string> ids;
    for (auto& p : content.processes) {
        if (p.id != loose_id) {
            if (p.icon) shift(*p.icon);
            p.name = free_name(system.processes, p.name);
            ids.push_back(p.id);
            system.processes.push_back(std::move(p));
            continue;
        }
        Process* target = find_process(system, process);  // adding processes may have moved it
        for (auto& g : p.groups) {
            if (g.icon) shift(*g.icon);
            g.name = free_name(target->groups, g.name);
            ids.push_back(g.id);
            target->groups.push_back(std::move(g));
        }
    }
    const auto add = [&](std::vector<CanvasComment>& all, std::string_view page) {
        for (auto& c : all) {
            shift(c.box);
            c.id = fresh_id(system, prefix + c.id);
            ids.push_back(add_canvas_comment(system, page, std::move(c)));
        }
    };
    add(comments, process);
    add(content.canvas_comments, {});
    const GroupIndex index(system);
    for (auto& c : content.connections) {
        // Groups in a process that was pasted as a whole stay where they are on its page.
        const auto *from = index.find(c.source).process, *to = index.find(c.target).process;
        if (c.line && (from != to || (groups && from->id == process)))
            for (Point& v : c.line->vertices) shift(v);
        ids.push_back(c.id);
    }
    for (auto& c : content.connections) system.connections.push_back(std::move(c));
    return ids;
}

}  // namespace forage::model
