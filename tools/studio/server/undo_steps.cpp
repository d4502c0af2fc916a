#include "tools/studio/server/undo_steps.h"

namespace forage::studio {
namespace {

using nlohmann::json;

constexpr std::size_t max_steps = 500;
constexpr std::size_t max_bytes = 64u << 20;      ///< of texts
constexpr std::size_t max_kept_bytes = 2u << 20;  ///< of these, in a checkpoint

/// How many of the latest steps are kept; at least one of them.
std::size_t kept(const std::vector<UndoStep>& steps, std::size_t max_text) {
    std::size_t count = 0, bytes = 0;
    for (auto it = steps.rbegin(); it != steps.rend() && count < max_steps; ++it, ++count)
        if (bytes += it->bytes(); bytes > max_text && count > 0) break;
    return count;
}

bool joins(const UndoStep& step, const UndoStep& last) {
    const auto runs = [](const UndoStep& s) { return s.world && s.world->running; };
    return !step.merge.empty() && step.merge == last.merge && step.undo.is_null() == last.undo.is_null() &&
           step.system.has_value() == last.system.has_value() &&
           step.world.has_value() == last.world.has_value() && runs(step) == runs(last);
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
    undo.erase(undo.begin(), undo.end() - static_cast<std::ptrdiff_t>(kept(undo, max_bytes)));
}

std::vector<std::string*> UndoSteps::texts_of_system() {
    std::vector<std::string*> out;
    for (auto* steps : {&undo, &redo})
        for (auto& step : *steps)
            if (step.system) out.push_back(&*step.system);
    return out;
}

void UndoSteps::checkpoint(Archive& archive) {
    for (auto* steps : {&undo, &redo}) {
        std::uint64_t count = kept(*steps, max_kept_bytes);
        archive(count);
        if (archive.loading()) steps->resize(count);
        for (auto it = steps->end() - static_cast<std::ptrdiff_t>(count); it != steps->end(); ++it)
            archive(*it);
    }
}

}  // namespace forage::studio
