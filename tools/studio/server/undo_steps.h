// The steps that undo and redo take: the one record of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/archive.h"

namespace forage::studio {

/// Texts of the world.
struct WorldTexts {
    std::string edited;
    std::optional<std::string> running;  ///< when the step acts on the run, too
    void checkpoint(Archive& archive) { archive(edited, running); }
};

/// A change that a page has made: of the text of the system or of the world, of the run, or of several of
/// them.
struct UndoStep {
    std::string title = {};
    std::string merge = {};                         ///< a step of the same name joins it; empty for none
    nlohmann::json undo = nullptr, redo = nullptr;  ///< actions of the run; null for none
    /// The texts before the step; of a step that is undone, those after it.
    std::optional<std::string> system = {};
    std::optional<WorldTexts> world = {};

    std::size_t bytes() const;  ///< of the texts
    void checkpoint(Archive& archive);
};

/// What can be undone, and what was undone.
struct UndoSteps {
    std::vector<UndoStep> undo, redo;

    void clear() { undo.clear(), redo.clear(); }
    /// Adds a step, or joins it to the last one. What was undone before cannot be repeated then.
    void add(UndoStep step);
    static nlohmann::json title(const std::vector<UndoStep>& steps) {
        return steps.empty() ? nlohmann::json(nullptr) : nlohmann::json(steps.back().title);
    }
    std::vector<std::string*> texts_of_system();
    /// Writes or reads the latest steps.
    void checkpoint(Archive& archive);
};

}  // namespace forage::studio
