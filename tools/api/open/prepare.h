// Creates a run from its description.
#pragma once

#include <optional>

#include "core/run/prepared_run.h"
#include "tools/api/open/sources.h"

namespace forage {

/// Creates and starts a run with its world and all observers that the spec names. The caller then begins the
/// recordings with begin_files(), or reads a checkpoint. All mistakes in the spec are reported here, before
/// the first cycle and before any file is written. Empty when `diagnostics` got an error.
std::optional<PreparedRun> prepare(const Sources& sources, const RunSpec& spec, Diagnostics& diagnostics);

/// Removes the unfinished files of a killed run from spec.directory, with a warning. Reports an error instead
/// when the directory holds the checkpoint of an unfinished run, unless spec.discard_checkpoint is set.
void clear_directory(const RunSpec& spec, Diagnostics& diagnostics);

}  // namespace forage
