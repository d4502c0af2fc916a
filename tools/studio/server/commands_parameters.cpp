#include <algorithm>

#include <fmt/format.h>

#include "tools/api/describe_json.h"
#include "tools/api/text_parts.h"
#include "tools/studio/server/command_functions.h"
#include "tools/studio/server/commands.h"
#include "tools/studio/server/equivalents.h"

namespace forage::studio {
namespace {

/// Whether an assignment switches a module on or off, which the description of the system says.
bool switches_module(const std::vector<std::string>& assignments) {
    return std::any_of(assignments.begin(), assignments.end(),
                       [](const auto& a) { return a.find(".enableModule=") != a.npos; });
}

}  // namespace

json Commands::parameters() {
    json out = describe_parameters(run(), c.at("item").get<std::string>());
    if (s.saved_values(out)) return out;
    for (auto& p : out["parameters"])
        if (const auto it = s.changed_.find(p["assignment"].get<std::string>()); it != s.changed_.end()) {
            p["loaded"] = it->second.loaded;
            if (p["at_start"]) p["value"] = value_in(it->second.assignment);
        }
    return out;
}

std::string Commands::value_in(const std::string& assignment) {
    return assignment.substr(std::min(assignment.find('=') + 1, assignment.size()));
}

std::vector<std::string> Commands::inverse(const std::vector<std::string>& assignments) {
    Diagnostics diagnostics;
    std::vector<model::Assignment> changes;
    std::vector<std::string> back;
    for (const std::string& text : assignments) {
        const auto change =
            model::parse_assignment(run().system(), run().registry(), text, "set", diagnostics);
        if (!change) continue;
        const std::string name = text.substr(0, text.find('='));
        ParameterValue now = model::value_of(run().system(), *change);
        if (const auto it = s.changed_.find(name); it != s.changed_.end() && at_start(*change)) {
            back.push_back(it->second.assignment);
        } else {
            if (!at_start(*change)) now = run().simulation().parameter(*change), changes.push_back(*change);
            back.push_back(name + "=" + to_text(now));
        }
    }
    run().simulation().check(changes, diagnostics);
    throw_errors(diagnostics);
    return back;
}

json Commands::set(const std::vector<std::string>& assignments, const std::string& title, bool undoable) {
    if (assignments.empty()) throw InputError("there is nothing to set");
    const auto back = inverse(assignments);
    json values = json::object();
    for (const auto& a : assignments) values[a.substr(0, a.find('='))] = value_in(a);
    const json command = {{"command", "set"}, {"assignments", assignments}};
    json told = this->told(command, title);
    told["values"] = values;
    const bool step = undoable && s.set_in_document(assignments, title);
    s.act(command, undoable ? std::optional<json>({{"command", "set"}, {"assignments", back}}) : std::nullopt,
          told);
    if (step) {
        s.undo_.back().document = true;
        if (switches_module(assignments)) s.tell(s.system_message());
        s.tell_document();
    }
    return {{"generation", s.generation_}};
}

json Commands::set() {
    const auto assignments = c.at("assignments").get<std::vector<std::string>>();
    std::string title = assignments.empty() ? "" : assignments.front();
    if (const auto equal = title.find('='); equal != title.npos) title.replace(equal, 1, " = ");
    if (assignments.size() > 1) title += fmt::format(" and {} more", assignments.size() - 1);
    return set(assignments, title, true);
}

json Commands::undo() { return back_or_forth(s.undo_, s.redo_, true); }

json Commands::redo() { return back_or_forth(s.redo_, s.undo_, false); }

json Commands::back_or_forth(std::vector<Session::Undo>& from, std::vector<Session::Undo>& to, bool back) {
    if (from.empty()) throw NothingLeft(back ? "there is nothing to undo" : "there is nothing to redo");
    Session::Undo entry = std::move(from.back());
    from.pop_back();
    const json& command = back ? entry.undo : entry.redo;
    const std::string title = (back ? "undo: " : "redo: ") + entry.title;
    if (entry.document) s.step_document(back);
    auto undone = std::move(s.undo_), redone = std::move(s.redo_);
    s.undo_.clear(), s.redo_.clear();
    const auto back_again = [&] { s.undo_ = std::move(undone), s.redo_ = std::move(redone); };
    try {
        if (command.is_null()) {
            s.follow_document(title);
        } else if (command.at("command") == "world_text") {
            const bool runs = command.contains("run");
            const auto ended = s.lost_by_rebuild();
            if (runs) run_in_world(command.at("run"));
            const auto replaced =
                json::array({editing::replace_operation(world_text().text, command.at("text"))});
            set_world_text(command.at("text"));
            tell_world_edit(title, of_world_edit(s.edited_file(world_text().path), replaced), runs, ended);
        } else {
            s.act(command, std::nullopt, told(command, title));
            if (entry.document) s.note_parameters(command.at("assignments").get<std::vector<std::string>>());
        }
    } catch (...) {  // what it touched is not there any more; the other steps stay
        back_again();
        if (command.is_object() && command.value("command", "") == "world_text") from.push_back(entry);
        throw;
    }
    back_again();
    const bool document = entry.document, world = command.is_object() && command["command"] == "world_text";
    const bool module = document && command.is_object() && command["command"] == "set" &&
                        switches_module(command["assignments"].get<std::vector<std::string>>());
    to.push_back(std::move(entry));
    if (module) s.tell(s.system_message());
    if (document || world) s.tell_document();
    return {{"generation", s.generation_}};
}

}  // namespace forage::studio
