#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tools/api/describe/describe_json.h"
#include "tools/studio/server/commands.h"
#include "tools/studio/server/commands/shared.h"

namespace forage::studio {
namespace {

using Assignments = std::vector<std::string>;

std::string name_in(const std::string& assignment) { return assignment.substr(0, assignment.find('=')); }

std::string value_in(const std::string& assignment) {
    return assignment.substr(std::min(assignment.find('=') + 1, assignment.size()));
}

bool acts_at_start(const model::Assignment& a) { return !a.parameter || a.parameter->at_start; }

/// Whether an assignment switches a module on or off, which the description of the system says.
bool switches_module(const Assignments& assignments) {
    return std::ranges::any_of(assignments, [](const auto& a) { return a.find(".enableModule=") != a.npos; });
}

json set_by_page(Session& s, const Request& r) {
    const auto assignments = r.texts("assignments");
    std::string title = assignments.empty() ? "" : assignments.front();
    if (const auto equal = title.find('='); equal != title.npos) title.replace(equal, 1, " = ");
    if (assignments.size() > 1) title += fmt::format(" and {} more", assignments.size() - 1);
    return set_parameters(s, assignments, title);
}

void repeat_set(Session& s, const json& action) {
    for (const auto& text : action.at("assignments").get<Assignments>()) {
        Diagnostics diagnostics;
        const auto change =
            model::parse_assignment(s.run().system(), s.run().registry(), text, "set", diagnostics);
        throw_errors(diagnostics);
        const auto loaded =
            std::visit([](const auto& v) { return json(v); }, model::value_of(s.run().system(), *change));
        s.live.changed.try_emplace(name_in(text), Change{{}, loaded}).first->second.assignment = text;
        if (!acts_at_start(*change)) s.run().simulation().set(*change);
    }
}

Equivalent script_set(Session& s, const json& action) {
    return of_assignments(action.at("assignments").get<Assignments>(), s.run().cycle());
}

using Steps = std::vector<UndoStep>;

json back_or_forth(Session& s, Steps& from, Steps& to, bool back) {
    if (from.empty()) throw NothingLeft(back ? "there is nothing to undo" : "there is nothing to redo");
    UndoStep entry = std::move(from.back());
    from.pop_back();
    const json& command = back ? entry.undo : entry.redo;
    const bool is_world = command.is_object() && command.at("command") == "world_text";
    const bool is_set = command.is_object() && command.at("command") == "set";
    const std::string title = (back ? "undo: " : "redo: ") + entry.title;
    if (entry.document) back ? s.edited.document->undo() : s.edited.document->redo();
    auto undone = std::move(s.edited.steps.undo), redone = std::move(s.edited.steps.redo);
    s.edited.steps.undo.clear(), s.edited.steps.redo.clear();
    const auto restore_steps = [&] {
        s.edited.steps.undo = std::move(undone), s.edited.steps.redo = std::move(redone);
    };
    try {
        if (command.is_null()) {
            s.follow_document(title);
        } else if (is_world) {
            const bool runs = command.contains("run");
            const auto ended = s.lost_by_rebuild();
            if (runs) run_in_world(s, command.at("run"));
            set_world_text(s, command.at("text"));
            broadcast_world_edit(s, title, {}, runs, ended);
        } else {
            s.act(command, std::nullopt, described_action(s, command, title));
            if (entry.document) s.note_parameters(command.at("assignments").get<Assignments>());
        }
    } catch (...) {  // what it touched is not there any more; the other steps stay
        restore_steps();
        if (is_world) from.push_back(entry);
        throw;
    }
    restore_steps();
    if (entry.document && is_set && switches_module(command["assignments"].get<Assignments>()))
        s.pages.broadcast(s.system_message());
    if (entry.document || is_world) s.broadcast_document();
    to.push_back(std::move(entry));
    return {{"generation", s.edited.generation}};
}

}  // namespace

json describe_item_parameters(Session& s, const std::string& item) {
    json out = describe_parameters(s.run(), item);
    if (s.saved_values(out)) return out;
    for (auto& p : out["parameters"])
        if (const auto it = s.live.changed.find(p["assignment"].get<std::string>());
            it != s.live.changed.end()) {
            p["loaded"] = it->second.loaded;
            if (p["at_start"]) p["value"] = value_in(it->second.assignment);
        }
    return out;
}

std::vector<std::string> inverse(Session& s, const std::vector<std::string>& assignments) {
    Diagnostics diagnostics;
    std::vector<model::Assignment> changes;
    std::vector<std::string> back;
    auto& run = s.run();
    for (const std::string& text : assignments) {
        const auto change = model::parse_assignment(run.system(), run.registry(), text, "set", diagnostics);
        if (!change) continue;
        const auto name = name_in(text);
        ParameterValue now = model::value_of(run.system(), *change);
        if (const auto it = s.live.changed.find(name); it != s.live.changed.end() && acts_at_start(*change)) {
            back.push_back(it->second.assignment);
        } else {
            if (!acts_at_start(*change))
                now = run.simulation().parameter(*change), changes.push_back(*change);
            back.push_back(name + "=" + to_text(now));
        }
    }
    run.simulation().check(changes, diagnostics);
    throw_errors(diagnostics);
    return back;
}

json set_parameters(Session& s, const std::vector<std::string>& assignments, const std::string& title) {
    if (assignments.empty()) throw InputError("there is nothing to set");
    const json undo = {{"command", "set"}, {"assignments", inverse(s, assignments)}};
    const json action = {{"command", "set"}, {"assignments", assignments}};
    json described = described_action(s, action, title);
    for (const auto& a : assignments) described["values"][name_in(a)] = value_in(a);
    const bool step = s.set_in_document(assignments, title);
    s.act(action, undo, described);
    if (step) {
        s.edited.steps.undo.back().document = true;
        if (switches_module(assignments)) s.pages.broadcast(s.system_message());
        s.broadcast_document();
    }
    return {{"generation", s.edited.generation}};
}

json described_action(Session& s, const json& action, const std::string& title, const std::string& item) {
    const auto forms = find_command(action.at("command").get<std::string>()).script(s, action);
    json out = {{"title", title}, {"shell", forms.shell}, {"python", forms.python}};
    if (!item.empty()) out["item"] = item;
    return out;
}

std::vector<Command> parameter_commands() {
    const std::string generation = "{ generation: number }";
    return {
        {.name = "parameters",
         .doc = "Describes the parameters of an item.",
         .arguments = {{"item", text(), "the path, name or id of a group, process or connection"}},
         .result = "ItemParameters",
         .apply = [](Session& s, const Request& r) { return describe_item_parameters(s, r.text("item")); }},
        {.name = "set",
         .doc = "Sets parameters, all of them or none.",
         .arguments = {{"assignments", list(text()), "such as `Bug/Light.threshold=0.3`"}},
         .result = generation,
         .changes_run = true,
         .apply = set_by_page,
         .repeat = repeat_set,
         .script = script_set},
        {.name = "undo",
         .doc = "Undoes the last step of any page.",
         .result = generation,
         .changes_run = true,
         .apply =
             [](Session& s, const Request&) {
                 return back_or_forth(s, s.edited.steps.undo, s.edited.steps.redo, true);
             }},
        {.name = "redo",
         .doc = "Repeats the step that was undone last.",
         .result = generation,
         .changes_run = true,
         .apply =
             [](Session& s, const Request&) {
                 return back_or_forth(s, s.edited.steps.redo, s.edited.steps.undo, false);
             }},
    };
}

}  // namespace forage::studio
