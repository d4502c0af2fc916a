#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/model/expression.h"
#include "tools/api/describe/describe_json.h"
#include "tools/studio/server/commands.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"

namespace forage::studio {
namespace {

using Assignments = std::vector<std::string>;

std::string name_in(const std::string& assignment) {
    return std::string(expression::split_assignment(assignment).name);
}

std::string value_in(const std::string& assignment) {
    return std::string(expression::split_assignment(assignment).value);
}

bool acts_at_start(const model::Assignment& a) {
    if (a.owner == model::Assignment::Owner::constant) return false;
    return !a.parameter || a.parameter->at_start;
}

/// Throws InputError for the path of a file or device that no module may read or write.
void check_file(const model::System& system, const model::Assignment& a) {
    if (!a.parameter || a.parameter->kind != ParameterKind::text) return;
    if (const auto* use = model::find_use(system, a.id))
        check_parameter_file(use->type, *a.parameter, std::get<std::string>(a.value));
}

json set_by_page(Session& s, const Request& r) {
    const auto assignments = r.texts("assignments");
    std::string title;
    if (!assignments.empty())
        title = fmt::format("{} = {}", name_in(assignments.front()), value_in(assignments.front()));
    if (assignments.size() > 1) title += fmt::format(" and {} more", assignments.size() - 1);
    return set_parameters(s, assignments, title);
}

void repeat_set(Course& course, const json& action) {
    const auto& system = course.run->system();
    for (const auto& text : action.at("assignments").get<Assignments>()) {
        Diagnostics diagnostics;
        const auto change = model::parse_assignment(system, course.run->registry(), text, "set", diagnostics);
        throw_errors(diagnostics);
        const auto loaded =
            std::visit([](const auto& v) { return json(v); }, model::value_of(system, *change));
        course.changed.try_emplace(name_in(text), Change{{}, loaded}).first->second.assignment = text;
        if (!acts_at_start(*change)) course.run->simulation().set(*change);
    }
}

Equivalent script_set(Session& s, const json& action) {
    return of_assignments(action.at("assignments").get<Assignments>(), s.run().cycle());
}

json undo_set(Session& s, const json& action) {
    return {{"command", "set"}, {"assignments", inverse(s, action.at("assignments").get<Assignments>())}};
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
        check_file(run.system(), *change);
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
    inverse(s, assignments);  // checks them
    LoggedAction logged{.title = title};
    for (const auto& a : assignments) logged.values[name_in(a)] = value_in(a);
    UndoStep step;
    if (const auto before = s.edited.document->text(); s.set_in_document(assignments)) step.system = before;
    const bool changed = step.system.has_value();
    json out =
        take_step(s, {{"command", "set"}, {"assignments", assignments}}, std::move(logged), std::move(step));
    if (changed) {
        if (switches_module(assignments)) s.pages.broadcast(s.system_message());
        s.broadcast_document();
    }
    return out;
}

bool waits_for_start(Session& s, const std::string& assignment) {
    Diagnostics not_here;
    const auto a = model::parse_assignment(s.run().system(), s.run().registry(), assignment, "set", not_here);
    return !a || acts_at_start(*a);
}

bool switches_module(const std::vector<std::string>& assignments) {
    return std::ranges::any_of(assignments, [](const auto& a) { return a.find(".enableModule=") != a.npos; });
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
         .arguments = {{"assignments", texts(), "such as `Bug/Light.threshold=0.3`"}},
         .result = generation,
         .changes_run = true,
         .apply = set_by_page,
         .repeat = repeat_set,
         .inverse = undo_set,
         .script = script_set},
    };
}

}  // namespace forage::studio
