#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/xml/writer.h"
#include "tools/api/describe/describe_json.h"
#include "tools/api/edit/forms.h"
#include "tools/api/edit/operations.h"
#include "tools/api/edit/part_operations.h"
#include "tools/api/edit/wiring.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

using editing::carry_out;
using editing::json_of;
using editing::title_of;
using Owner = model::Assignment::Owner;

constexpr std::size_t max_pairs = 200'000;  ///< in a reply

std::string trimmed(const std::string& text) { return std::string(model::trim(text)); }

std::string target_of(const std::vector<model::CrossReference>& all, const std::string& name) {
    const auto* found = find_by(all, name, &model::CrossReference::name);
    return found ? found->target : "";
}

/// The properties of items.
struct Description {
    const model::System& system;
    const model::System& saved;
    const Registry& registry;
    const model::System& running;  ///< with the systems beside it, in which assignments name items

    /// The declaration of a type of this file; null for other types.
    static json declaration(const std::vector<model::TypeDeclaration>& all, const std::string& type) {
        const auto* found = find_by(all, type, &model::TypeDeclaration::name);
        return found ? describe_declaration(*found) : json();
    }
    template <class Type>
    json settings(const model::TypeUse& use, const Type* type, model::Assignment::Owner owner,
                  const std::string& id) {
        if (!type) return json::array();
        return describe_settings(use, model::find_use(saved, id), type->parameters,
                                 model::assignment_name(running, owner, id));
    }
    json of(const model::Group& g, const model::Process& p) {
        return {{"kind", "group"},
                {"process", p.id},
                {"name", trimmed(g.name)},
                {"path", model::path(system, p, g)},
                {"color", g.color},
                {"note", g.note.value_or("")},
                {"icon", icon_of(g.icon)},
                {"neuron", g.neuron.type},
                {"topology", json_of(g.topology)},
                {"cells", model::shape(g.topology).cells},
                {"linked", p.linked()},
                {"declaration", declaration(system.neuron_types, g.neuron.type)},
                {"parameters", settings(g.neuron, registry.neuron(g.neuron.type), Owner::group, g.id)}};
    }
    json of(const model::Process& p) {
        json out = {{"kind", "process"},           {"name", trimmed(p.name)},  {"color", p.color},
                    {"note", p.note.value_or("")}, {"icon", icon_of(p.icon)},  {"enabled", p.module_enabled},
                    {"linked", p.linked()},        {"path", p.path},           {"module", nullptr},
                    {"inputs", json::array()},     {"outputs", json::array()}, {"parameters", json::array()}};
        out["constants"] = describe_constants(system, saved, &p);
        if (!p.module) return out;
        out["module"] = p.module->type;
        const auto* type = registry.module(p.module->type);
        if (!type) return out;
        out["parameters"] = settings(*p.module, type, Owner::process, p.id);
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
                    {"sign", name_of(c.kind)},
                    {"synapse", c.synapse ? c.synapse->type : ""},
                    {"pattern", json_of(c.pattern)},
                    {"arborization", json_of(c.arborization)},
                    {"attenuation", json_of(c.attenuation)},
                    {"delay", json_of(c.delay)},
                    {"linked", c.linked},
                    {"declaration", c.synapse ? declaration(system.synapse_types, c.synapse->type) : json()},
                    {"feedback", json::array()},
                    {"states", json::array()},
                    {"parameters", json::array()}};
        const model::GroupIndex groups(system);
        const auto *source = groups.find(c.source).group, *target = groups.find(c.target).group;
        out["wiring"] =
            source && target ? editing::wiring_of(c, source->topology, target->topology) : "advanced";
        if (const auto* g = target)
            if (const auto* type = registry.neuron(g->neuron.type))
                for (const auto& s : type->states) out["states"].push_back(s.name);
        if (!c.synapse) return out;
        const auto* type = registry.synapse(c.synapse->type);
        if (!type) return out;
        out["parameters"] = settings(*c.synapse, type, Owner::connection, c.id);
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
        if (const auto* p = find_by(system.processes, id, &model::Process::id)) return of(*p);
        if (const auto* c = find_by(system.connections, id, &model::Connection::id)) return of(*c);
        constexpr auto its_id = &model::CanvasComment::id;
        if (const auto* comment = find_by(system.canvas_comments, id, its_id)) return of(*comment, false);
        for (const auto& p : system.processes)
            if (const auto* comment = find_by(p.canvas_comments, id, its_id)) return of(*comment, p.linked());
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
                {"cycles_per_second", system.cycles_per_second},
                {"constants", describe_constants(system, saved, nullptr)},
                {"parameters", json::array()}};
    }
};

/// The script of operations that made these ids; empty for parameters, which have that of `set`.
Equivalent script_edit(const Session& s, json operations, const json& ids) {
    const auto is_parameter = [](const json& o) { return o.value("do", "") == "parameter"; };
    if (s.edited.current && std::ranges::all_of(operations, is_parameter)) return {};
    for (std::size_t i = 0; i < operations.size(); ++i)
        if (ids[i].is_string() && operations[i].value("do", "").starts_with("add_"))
            operations[i]["id"] = ids[i];
    return of_edit(s.edited_file(s.edited.document->path()), operations);
}

json list_parts(Session& s, const Request&) {
    json out = json::array();
    const auto add = [&](const std::filesystem::path& folder, bool shipped) {
        for (const auto& part : editing::parts_in(folder.string()))
            out.push_back({{"file", part.file},
                           {"name", part.name},
                           {"about", part.about},
                           {"ports", part.ports},
                           {"constants", part.constants},
                           {"shipped", shipped}});
    };
    const auto library = std::filesystem::path(s.shipped()) / "parts";
    std::error_code ignored;
    if (!std::filesystem::equivalent(system_folder(s), library, ignored)) add(system_folder(s), false);
    if (!s.shipped().empty()) add(library, true);
    return {{"parts", std::move(out)}};
}

/// The number of synapses of a connection of the document; 0 when it cannot be built.
std::size_t count_synapses(Session& s, const std::string& connection) {
    if (s.edited.current) {  // the run has counted them
        const auto& all = s.run().layout().connections;
        const auto it = std::ranges::find(all, connection, &engine::Layout::Connection::id);
        if (it != all.end()) return s.run().simulation().synapses(static_cast<int>(it - all.begin()));
    }
    try {
        return describe_synapses(s.edited.document->system(), connection, s.run().seed(), 0)["synapses"];
    } catch (const InputError&) {
        return 0;
    }
}

/// The id of an item that a command names.
std::string item_id(const Session& s, const std::string& item) {
    return item == "system" ? s.edited.document->system().id : item;
}

json describe_item(Session& s, const Request& r) {
    const auto& id = r.text("item");
    const auto& document = *s.edited.document;
    const auto& registry = s.run().registry();
    const auto all = s.shown_system();
    json out = Description{document.system(), document.saved_system(), registry, all}.of(id);
    if (out.is_null()) {  // another system that runs, too; it has no document
        out = Description{all, all, registry, all}.of(id);
        if (out.is_null()) throw InputError(fmt::format("there is no item with the id '{}'", id));
        out["other_system"] = true;
        if (out["kind"] != "comment") out["parameters"] = describe_item_parameters(s, id)["parameters"];
    }
    if (out["kind"] == "connection") out["synapses"] = count_synapses(s, id);
    out["id"] = id;
    const bool here = !out.value("linked", false) && !out.contains("other_system") &&
                      (document.readable() || out["kind"] == "system");
    out["text"] = here ? document.item_text(item_id(s, id)) : "";
    return out;
}

json replace_item_text(Session& s, const Request& r) {
    const auto& item = r.text("item");
    const auto title = "edit the text of " + (item == "system" ? "the system" : item);
    const auto before = s.edited.document->text();
    s.edited.document->replace_item_text(item_id(s, item), r.text("text"));
    return follow_edit(s, {.title = title, .system = before});
}

json check_item_text(Session& s, const Request& r) {
    const auto found = s.edited.document->check_item_text(item_id(s, r.text("item")), r.text("text"),
                                                          s.run().registry(), s.run().environment());
    return {{"problems", problems_of(found)}};
}

json replace_text(Session& s, const Request& r) {
    const auto before = s.edited.document->text();
    s.edited.document->write_text(r.text("text"));
    return follow_edit(s,
                       {.title = "edit the text of the system", .merge = r.text("merge"), .system = before});
}

json copy_items(Session& s, const Request& r) {
    const auto connections = r.flag("connections") ? model::Between::all : model::Between::named;
    return {
        {"text", xml::write_system(model::copy(s.edited.document->system(), r.texts("ids"), connections))}};
}

constexpr const char* connection_parts[] = {"pattern", "arborization", "attenuation", "delay"};

json preview_connection(Session& s, const Request& r) {
    model::System system = s.edited.document->system();
    const auto& id = r.text("connection");
    editing::EditFiles files(s.edited.document->path());
    for (const char* part : connection_parts)
        if (r.has(part))
            carry_out({{"do", part}, {"id", id}, {part, r[part]}}, system, s.run().registry(), files);
    model::System alone;
    if (const auto* connection = find_by(system.connections, id, &model::Connection::id))
        alone.connections.push_back(*connection);
    Diagnostics files_of_page;
    check_system_files(alone, s.run().registry(), files_of_page);
    throw_errors(files_of_page);
    return describe_synapses(system, id, s.run().seed(), max_pairs);
}

}  // namespace

json edit_document(Session& s, const json& operations, std::string title, const std::string& merge) {
    auto& document = *s.edited.document;
    if (operations.empty()) throw InputError("there is no operation");
    if (title.empty()) {
        title = title_of(operations.front(), document.system());
        if (operations.size() > 1) title += fmt::format(" and {} more", operations.size() - 1);
    }
    check_operation_files(s, operations);
    json ids = json::array();
    const std::string before = document.text();
    editing::EditFiles files(document.path());
    document.edit([&](model::System& system) {
        for (const auto& o : operations) ids.push_back(carry_out(o, system, s.run().registry(), files));
    });
    files.keep();
    json out = follow_edit(s, {.title = std::move(title), .merge = merge, .system = before},
                           script_edit(s, operations, ids));
    out["ids"] = std::move(ids);
    out["warnings"] = collected(files.warnings.all(), &Diagnostic::message);
    return out;
}

json follow_edit(Session& s, UndoStep step, const Equivalent& script) {
    if (s.edited.document->text() != *step.system) {
        const auto title = step.title;
        s.edited.steps.add(std::move(step));
        s.follow_document(title, script);
        s.broadcast_document();
    }
    return {{"generation", s.edited.generation}};
}

std::vector<Command> editing_commands() {
    const Member item{"item", text(), "an id, or `system`"};
    const auto merge = optional("merge", text(), "", "joins the step before when that has the same name");
    const std::string generation = "{ generation: number }";
    std::vector<Member> previewed = {{"connection", text(), "an id"}};
    for (const char* part : connection_parts)
        previewed.push_back(optional(part, any(), nullptr, "by default the present one"));
    return {
        {.name = "edit",
         .doc = "Carries out [operations](#operations), all of them or none, as one step. Returns the id "
                "that each one made, a list of ids, or null.",
         .arguments = {{"operations", list(record({}, "Operation"))}, optional("title", text(), ""), merge},
         .result = "{ ids: (string | string[] | null)[]; warnings: string[]; generation: number }",
         .changes_run = true,
         .apply =
             [](Session& s, const Request& r) {
                 return edit_document(s, r["operations"], r.text("title"), r.text("merge"));
             }},
        {.name = "parts",
         .doc = "Lists the parts that the operation `use_part` can add: the process files with ports in the "
                "folder of the system, and those that come with Forage.",
         .result = "{ parts: PartSummary[] }",
         .apply = list_parts},
        {.name = "item",
         .doc =
             "Describes an item and its text. What is `linked` is in the file of a linked process, what has "
             "`other_system` runs beside the system that is edited; both have no text and refuse operations.",
         .arguments = {item},
         .result = "EditItem",
         .apply = describe_item},
        {.name = "item_text",
         .doc = "Replaces the text of the element of an item.",
         .arguments = {item, {"text", text()}},
         .result = generation,
         .changes_run = true,
         .apply = replace_item_text},
        {.name = "item_check",
         .doc = "Returns what would be wrong with a text of the element of an item. Lines and columns are "
                "those of `text`, and 0 when something elsewhere becomes wrong.",
         .arguments = {item, {"text", text()}},
         .result = "{ problems: Problem[] }",
         .apply = check_item_text},
        {.name = "text_edit",
         .doc = "Replaces the whole text of the system, also by one with mistakes.",
         .arguments = {{"text", text()}, merge},
         .result = generation,
         .changes_run = true,
         .apply = replace_text},
        {.name = "copy",
         .doc = "Returns items and the connections among their groups, for the operation `paste`.",
         .arguments = {{"ids", texts()},
                       optional("connections", boolean(), true, "false: only those that `ids` names")},
         .result = "{ text: string }",
         .apply = copy_items},
        {.name = "types",
         .doc = "Lists the types of neurons, synapses, modules, arborizations and functions of distance.",
         .result = "TypesResult",
         .apply = [](Session& s, const Request&) { return describe_types(s.run().registry()); }},
        {.name = "vocabulary",
         .doc = "Lists the elements and attributes of a system file.",
         .result = "Vocabulary",
         .apply = [](Session&, const Request&) { return describe_vocabulary(); }},
        {.name = "preview",
         .doc = "Returns which cells, from 0, a connection would join with another pattern or other "
                "functions; at most 200000 pairs of `synapses`. Changes nothing.",
         .arguments = previewed,
         .result = "PreviewResult",
         .apply = preview_connection},
    };
}

}  // namespace forage::studio
