#include <utility>

#include "tools/studio/server/commands.h"
#include "tools/studio/server/commands/shared.h"

namespace forage::studio {
namespace {

using Steps = std::vector<UndoStep>;

/// Exchanges what the last step of `from` holds with what is there now.
json exchange_step(Session& s, Steps& from, Steps& to, bool back) {
    if (from.empty()) throw NothingLeft(back ? "there is nothing to undo" : "there is nothing to redo");
    UndoStep& last = from.back();
    const std::string title = (back ? "undo: " : "redo: ") + last.title;
    const auto ended = s.lost_by_rebuild();
    const bool runs = last.world && last.world->running;
    if (runs) {  // or the step stays
        const auto now = running_world(s);
        run_in_world(s, *last.world->running);
        last.world->running = now;
    }
    UndoStep step = std::move(last);
    from.pop_back();
    step.merge.clear();
    if (step.world) {
        set_world_text(s, std::exchange(step.world->edited, world_text(s).text));
        log_world_edit(s, {.title = title, .ended = ended}, runs);
    }
    s.pages.status_due = true;
    const json& action = back ? step.undo : step.redo;
    // Throws when what it acts on is not there any more; the step is gone then.
    if (!action.is_null()) s.act(action, {.title = title});
    if (step.system) {
        const auto now = s.edited.document->text();
        s.edited.document->write_text(std::exchange(*step.system, now));
        if (action.is_null()) {
            s.follow_document(title);
        } else {
            const auto assignments = action.at("assignments").get<std::vector<std::string>>();
            s.note_parameters(assignments);
            if (switches_module(assignments)) s.pages.broadcast(s.system_message());
        }
    }
    to.push_back(std::move(step));
    s.broadcast_document();
    return {{"generation", s.edited.generation}};
}

}  // namespace

json take_step(Session& s, const json& action, LoggedAction logged, UndoStep step) {
    s.live.repeat_actions();
    step.title = logged.title, step.redo = action;
    step.undo = find_command(action.at("command")).inverse(s, action);
    s.act(action, std::move(logged));
    s.edited.steps.add(std::move(step));
    return {{"generation", s.edited.generation}};
}

std::vector<Command> undo_commands() {
    const std::string generation = "{ generation: number }";
    return {
        {.name = "undo",
         .doc = "Undoes the last step of any page.",
         .result = generation,
         .changes_run = true,
         .apply =
             [](Session& s, const Request&) {
                 return exchange_step(s, s.edited.steps.undo, s.edited.steps.redo, true);
             }},
        {.name = "redo",
         .doc = "Repeats the step that was undone last.",
         .result = generation,
         .changes_run = true,
         .apply =
             [](Session& s, const Request&) {
                 return exchange_step(s, s.edited.steps.redo, s.edited.steps.undo, false);
             }},
    };
}

}  // namespace forage::studio
