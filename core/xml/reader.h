// .iqr and .iqrProcess files -> model.
#pragma once

#include <optional>
#include <string>

#include "core/model/system.h"

namespace forage::xml {

/// Reads a system file, and the files of its linked processes, and reports every problem of its form. Where
/// that left no doubt what the rest of the file says, the system is returned in spite of errors, so that
/// model::validate() can report what else is wrong: only a system without errors in `diagnostics` is fit to
/// run.
std::optional<model::System> read_system(const std::string& path, Diagnostics& diagnostics);

/// The same for a text that a person knows as `path`. Links are relative to the directory of `path`.
std::optional<model::System> parse_system(std::string path, std::string text, Diagnostics& diagnostics);

/// Reads a process file, under the same terms.
std::optional<model::ProcessFile> read_process(const std::string& path, Diagnostics& diagnostics);

}  // namespace forage::xml
