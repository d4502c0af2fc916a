#include <algorithm>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/xml/writer.h"
#include "tools/api/describe_json.h"
#include "tools/api/forms.h"
#include "tools/api/operations.h"
#include "tools/studio/server/command_functions.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

using editing::carry_out;
using editing::json_of;
using editing::title_of;

constexpr std::size_t most_pairs = 200'000;  ///< in a reply
constexpr const char* signs[] = {"excitatory", "inhibitory", "modulatory"};

std::string trimmed(const std::string& text) { return std::string(model::trim(text)); }

template <class Items>
auto* with_id(const Items& items, std::string_view id) {
    const auto it =
        std::ranges::find(items, id, [](const auto& item) -> std::string_view { return item.id; });
    return it == items.end() ? nullptr : &*it;
}

json icon_of(const std::optional<model::Icon>& icon) {
    if (!icon) return nullptr;
    return {{"x", icon->x}, {"y", icon->y}, {"width", icon->width}, {"height", icon->height}};
}

std::string target_of(const std::vector<model::CrossReference>& all, const std::string& name) {
    const auto it = std::ranges::find(all, name, &model::CrossReference::name);
    return it == all.end() ? "" : it->target;
}

/// The properties of items.
struct Description {
    const model::System& system;
    const model::System& saved;
    const Registry& registry;

    template <class Type>
    json settings(const model::TypeUse& use, const Type* type, const std::string& id,
                  const std::string& name) {
        if (!type) return json::array();
        return describe_settings(use, model::find_use(saved, id), type->parameters, name);
    }
    json of(const model::Group& g, const model::Process& p) {
        const auto name = model::path(system, p, g);
        return {{"kind", "group"},
                {"process", p.id},
                {"name", trimmed(g.name)},
                {"path", name},
                {"color", g.color},
                {"note", g.note.value_or("")},
                {"icon", icon_of(g.icon)},
                {"neuron", g.neuron.type},
                {"topology", json_of(g.topology)},
                {"cells", model::shape(g.topology).cells},
                {"linked", p.linked()},
                {"parameters", settings(g.neuron, registry.neuron(g.neuron.type), g.id, name)}};
    }
    json of(const model::Process& p) {
        json out = {{"kind", "process"},           {"name", trimmed(p.name)},  {"color", p.color},
                    {"note", p.note.value_or("")}, {"icon", icon_of(p.icon)},  {"enabled", p.module_enabled},
                    {"linked", p.linked()},        {"path", p.path},           {"module", nullptr},
                    {"inputs", json::array()},     {"outputs", json::array()}, {"parameters", json::array()}};
        if (!p.module) return out;
        out["module"] = p.module->type;
        const auto* type = registry.module(p.module->type);
        if (!type) return out;
        out["parameters"] = settings(*p.module, type, p.id, trimmed(p.name));
        for (const auto& port : type->ports)
            out[port.is_output ? "outputs" : "inputs"].push_back(
                {{"name", port.name},
                 {"label", port.label},
                 {"doc", port.doc},
                 {"optional", port.optional},
                 {"group", target_of(port.is_output ? p.module->outputs : p.module->inputs, port.name)}});
        if (type->any_ports)
            for (const auto* side : {&p.module->inputs, &p.module->outputs})
                for (const auto& r : *side)
                    out[side == &p.module->inputs ? "inputs" : "outputs"].push_back({{"name", r.name},
                                                                                     {"label", r.name},
                                                                                     {"doc", ""},
                                                                                     {"optional", true},
                                                                                     {"group", r.target}});
        return out;
    }
    json of(const model::Connection& c) {
        json out = {{"kind", "connection"},
                    {"name", trimmed(c.name)},
                    {"note", c.note.value_or("")},
                    {"source", c.source},
                    {"target", c.target},
                    {"sign", signs[static_cast<int>(c.kind)]},
                    {"synapse", c.synapse ? c.synapse->type : ""},
                    {"pattern", json_of(c.pattern)},
                    {"arborization", json_of(c.arborization)},
                    {"attenuation", json_of(c.attenuation)},
                    {"delay", json_of(c.delay)},
                    {"linked", c.linked},
                    {"feedback", json::array()},
                    {"states", json::array()},
                    {"parameters", json::array()}};
        const model::GroupIndex groups(system);
        if (const auto* g = groups.find(c.target).group)
            if (const auto* type = registry.neuron(g->neuron.type))
                for (const auto& s : type->states) out["states"].push_back(s.name);
        if (!c.synapse) return out;
        const auto* type = registry.synapse(c.synapse->type);
        if (!type) return out;
        const auto same_name = std::ranges::count_if(
            system.connections, [&](const auto& other) { return trimmed(other.name) == trimmed(c.name); });
        out["parameters"] = settings(*c.synapse, type, c.id, same_name > 1 ? c.id : trimmed(c.name));
        for (const auto& f : type->feedback)
            out["feedback"].push_back({{"name", f.name},
                                       {"label", f.label},
                                       {"required", f.required},
                                       {"state", target_of(c.synapse->feedback, f.name)}});
        return out;
    }
    json of(const model::CanvasComment& c, bool in_linked_process) {
        return {{"kind", "comment"},           {"name", model::first_words(c.text)},
                {"content", c.text},           {"color", c.color},
                {"width", c.box.width},        {"height", c.box.height},
                {"linked", in_linked_process}, {"parameters", json::array()}};
    }
    /// The properties of the item with this id; null when there is none.
    json of(const std::string& id) {
        if (id == "system" || id == system.id) return of_system();
        if (const auto* p = with_id(system.processes, id)) return of(*p);
        if (const auto* connection = with_id(system.connections, id)) return of(*connection);
        if (const auto* comment = with_id(system.canvas_comments, id)) return of(*comment, false);
        for (const auto& p : system.processes)
            if (const auto* comment = with_id(p.canvas_comments, id)) return of(*comment, p.linked());
        const auto found = model::GroupIndex(system).find(id);
        return found.group ? of(*found.group, *found.process) : json();
    }
    json of_system() {
        return {{"kind", "system"},
                {"name", trimmed(system.name)},
                {"author", system.author},
                {"date", system.date},
                {"note", system.note.value_or("")},
                {"port", system.port},
                {"sync_plots", system.sync_plots},
                {"cycles_per_second", system.cycles_per_second}};
    }
};

}  // namespace

Document& Commands::document() { return *s.document_; }

json Commands::edited(const std::string& title, const std::string& text_before, const json& operations) {
    s.add_undo({nullptr, nullptr, title, true});
    s.follow_document(title, text_before, operations);
    s.tell_document();
    return {{"generation", s.generation_}};
}

bool Commands::joins_document() const {
    return s.undo_.empty() || (s.undo_.back().document && s.undo_.back().undo.is_null());
}

json Commands::edit() {
    const auto& operations = c.at("operations");
    if (!operations.is_array() || operations.empty()) throw InputError("there is no operation");
    std::string title = c.value("title", "");
    if (title.empty()) {
        title = title_of(operations.front(), document().system());
        if (operations.size() > 1) title += fmt::format(" and {} more", operations.size() - 1);
    }
    json ids = json::array();
    const std::string before = document().text();
    const bool step = document().edit(
        [&](model::System& system) {
            for (const auto& o : operations)
                ids.push_back(carry_out(o, system, run().registry(), document().path()));
        },
        title, joins_document() ? c.value("merge", "") : "");
    json named = operations;
    for (std::size_t i = 0; i < named.size(); ++i)
        if (ids[i].is_string() && named[i].value("do", "").starts_with("add_")) named[i]["id"] = ids[i];
    if (step) {
        edited(title, before, named);
    } else if (document().text() != before) {  // it joined the step before
        s.follow_document(title, before, named);
        s.tell_document();
    }
    return {{"ids", std::move(ids)}, {"generation", s.generation_}};
}

std::size_t Commands::synapses_of(const std::string& connection) {
    if (s.current_) {  // the run has counted them
        const auto& all = run().layout().connections;
        const auto it = std::ranges::find(all, connection, &engine::Layout::Connection::id);
        if (it != all.end()) return run().simulation().synapses(static_cast<int>(it - all.begin()));
    }
    try {
        return describe_synapses(document().system(), connection, run().seed(), 0)["synapses"];
    } catch (const InputError&) {
        return 0;
    }
}

json Commands::item() {
    const auto id = c.at("item").get<std::string>();
    const auto& system = document().system();
    json out = Description{system, document().saved_system(), run().registry()}.of(id);
    if (out.is_null()) {  // another system that runs, too; it has no document
        const auto all = s.shown_system();
        out = Description{all, all, run().registry()}.of(id);
        if (out.is_null()) throw InputError(fmt::format("there is no item with the id '{}'", id));
        out["other_system"] = true;
        if (out["kind"] != "comment") out["parameters"] = parameters()["parameters"];
    }
    if (out["kind"] == "connection") out["synapses"] = synapses_of(id);
    out["id"] = id;
    const bool here = !out.value("linked", false) && !out.contains("other_system") &&
                      (document().readable() || out["kind"] == "system");
    out["text"] = here ? document().item_text(id == "system" ? system.id : id) : "";
    return out;
}

json Commands::item_text() {
    const auto id = c.at("item").get<std::string>();
    const auto title = "edit the text of " + (id == "system" ? "the system" : id);
    if (!document().replace_item_text(id == "system" ? document().system().id : id,
                                      c.at("text").get<std::string>(), title))
        return {{"generation", s.generation_}};
    return edited(title);
}

json Commands::item_check() {
    const auto id = c.at("item").get<std::string>();
    const auto found =
        document().check_item_text(id == "system" ? document().system().id : id,
                                   c.at("text").get<std::string>(), run().registry(), run().environment());
    return {{"problems", problems_of(found)}};
}

json Commands::text_edit() {
    const std::string title = "edit the text of the system", before = document().text();
    const bool step = document().write_text(c.at("text").get<std::string>(), title,
                                            joins_document() ? c.value("merge", "") : "");
    if (step) return edited(title);
    if (document().text() != before) {  // it joined the step before
        s.follow_document(title);
        s.tell_document();
    }
    return {{"generation", s.generation_}};
}

json Commands::copy() {
    const auto ids = c.at("ids").get<std::vector<std::string>>();
    const auto connections = c.value("connections", true) ? model::Between::all : model::Between::named;
    return {{"text", xml::write_system(model::copy(document().system(), ids, connections))}};
}

json Commands::types() { return describe_types(run().registry()); }

json Commands::vocabulary() { return describe_vocabulary(); }

json Commands::preview() {
    model::System system = document().system();
    const auto id = c.at("connection").get<std::string>();
    for (const char* part : {"pattern", "arborization", "attenuation", "delay"})
        if (c.contains(part))
            carry_out({{"do", part}, {"id", id}, {part, c[part]}}, system, run().registry(), "");
    return describe_synapses(system, id, run().seed(), most_pairs);
}

}  // namespace forage::studio
