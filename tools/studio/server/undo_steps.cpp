#include "tools/studio/server/undo_steps.h"

namespace forage::studio {
namespace {

using nlohmann::json;

constexpr std::size_t max_steps = 500;
constexpr std::size_t max_bytes = 64u << 20;      ///< of texts
constexpr std::size_t max_kept_bytes = 2u << 20;  ///< of these, in a checkpoint

/// Drops the oldest steps; the last one stays.
void trim(std::vector<UndoStep>& steps, std::size_t max_text) {
    std::size_t count = 0, bytes = 0;
    for (auto it = steps.rbegin(); it != steps.rend(); ++it) {
        bytes += it->bytes();
        if (++count > max_steps || (bytes > max_text && count > 1)) {
            steps.erase(steps.begin(), it.base());
            return;
        }
    }
}

bool joins(const UndoStep& step, const UndoStep& last) {
    return !step.merge.empty() && step.merge == last.merge && step.undo.is_null() == last.undo.is_null() &&
           step.system.has_value() == last.system.has_value() &&
           step.world.has_value() == last.world.has_value();
}

}  // namespace

std::size_t UndoStep::bytes() const {
    std::size_t out = system ? system->size() : 0;
    if (world) out += world->edited.size() + (world->running ? world->running->size() : 0);
    return out;
}

void UndoStep::checkpoint(Archive& archive) {
    archive(title, merge, system, world);
    for (json* action : {&undo, &redo}) {
        std::string text = action->dump(-1, ' ', false, json::error_handler_t::replace);
        archive(text);
        if (archive.loading()) *action = json::parse(text);
    }
}

void UndoSteps::add(UndoStep step) {
    if (redo.empty() && !undo.empty() && joins(step, undo.back())) {
        undo.back().title = std::move(step.title), undo.back().redo = std::move(step.redo);
        return;
    }
    undo.push_back(std::move(step));
    redo.clear();
    trim(undo, max_bytes);
}

std::vector<std::string*> UndoSteps::texts_of_system() {
    std::vector<std::string*> out;
    for (auto* steps : {&undo, &redo})
        for (auto& step : *steps)
            if (step.system) out.push_back(&*step.system);
    return out;
}

void UndoSteps::checkpoint(Archive& archive) {
    auto kept = undo;
    trim(kept, max_kept_bytes);
    archive(kept, redo);
    if (archive.loading()) undo = std::move(kept);
}

}  // namespace forage::studio
