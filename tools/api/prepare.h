// Makes a run of its description.
#pragma once

#include <optional>

#include "core/run/prepared_run.h"
#include "tools/api/sources.h"

namespace forage {

/// Builds and starts the run with its world and every observer that the spec asks for. Only recordings do not begin yet: the
/// caller calls begin(), or reads a checkpoint. Whatever is wrong with the spec is reported here, before the first cycle and
/// before anything is written; empty when `diagnostics` got an error.
std::optional<PreparedRun> prepare(const Sources& sources, const RunSpec& spec, Diagnostics& diagnostics);

/// Removes what a run that was killed left unfinished in spec.directory, with a warning. Reports an error instead when the directory
/// holds the checkpoint of an unfinished run, unless spec.discard_checkpoint gives it up.
void clear_directory(const RunSpec& spec, Diagnostics& diagnostics);

/// Begins the files of a run that is not resumed. Throws std::runtime_error, also when something that is no file has the name of
/// a file to be written.
void begin(PreparedRun& prepared);

}  // namespace forage
