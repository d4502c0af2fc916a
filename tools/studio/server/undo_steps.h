// The steps that undo and redo take.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace forage::studio {

/// A step of the run, the document, or the text of the world.
struct UndoStep {
    nlohmann::json undo, redo;  ///< actions; null when the document alone says what changes
    std::string title;
    bool document = false;   ///< whether it is a step of the document, too
    std::string merge = {};  ///< a move of the same name joins it; empty for none

    /// Of the texts that it holds.
    std::size_t bytes() const {
        std::size_t out = 0;
        for (const auto* command : {&undo, &redo})
            if (command->is_object())
                for (const char* text : {"text", "run"})
                    if (const auto it = command->find(text); it != command->end() && it->is_string())
                        out += it->get_ref<const std::string&>().size();
        return out;
    }
};

/// What can be undone, and what was undone.
struct UndoSteps {
    std::vector<UndoStep> undo, redo;

    void clear() { undo.clear(), redo.clear(); }
    /// Adds a step; what was undone before cannot be repeated. The document has `document_steps`.
    void add(UndoStep step, std::size_t document_steps) {
        undo.push_back(std::move(step));
        redo.clear();
        trim(document_steps);
    }
    /// Whether the last step is a move of this name, so that the next one joins it.
    bool joins(const std::string& merge) const {
        return !merge.empty() && !undo.empty() && undo.back().merge == merge;
    }
    static nlohmann::json title(const std::vector<UndoStep>& steps) {
        return steps.empty() ? nlohmann::json(nullptr) : nlohmann::json(steps.back().title);
    }
    /// Drops the oldest steps.
    void trim(std::size_t document_steps) {
        constexpr std::size_t max_steps = 500;
        constexpr std::size_t max_bytes =
            8u << 20;  // steps of the world hold its text; the document bounds its own
        std::size_t steps = 0, bytes = 0;
        for (auto it = undo.rbegin(); it != undo.rend(); ++it) {
            const bool large = (bytes += it->bytes()) > max_bytes && it != undo.rbegin();
            // A step of the document can be undone while the document has it.
            if (++steps > max_steps || large || (it->document && document_steps-- == 0)) {
                undo.erase(undo.begin(), it.base());
                return;
            }
        }
    }
};

}  // namespace forage::studio
