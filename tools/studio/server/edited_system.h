// The system of a session as pages edit it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/run/run_spec.h"
#include "tools/api/edit/document.h"
#include "tools/studio/server/undo_steps.h"

namespace forage::studio {

/// The text of the world's file.
struct WorldText {
    std::string path, text, saved;
};

struct EditedSystem {
    RunInput input;                  ///< as the system was opened
    std::optional<RunInput> wanted;  ///< as a system with mistakes was opened, until it runs
    Diagnostics mistakes;            ///< of such a system
    std::int64_t opened = 0;         ///< ms since 1970; another number says that the system is another one
    std::uint64_t generation = 0;    ///< grows with each accepted action
    std::optional<Document> document;
    std::vector<Document::Problem> problems;  ///< of the document
    std::vector<model::System> others;        ///< systems that run beside it
    model::System built;                      ///< the document's system that runs
    bool current = true;                      ///< whether the run is that of the document
    bool outside = false;                     ///< whether another program has changed the file
    double outside_checked_at = -1e9;
    std::optional<WorldText> world_text;  ///< when it is edited
    UndoSteps steps;
};

}  // namespace forage::studio
