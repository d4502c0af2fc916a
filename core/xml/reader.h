// Reads .iqr and .iqrProcess files into models.
#pragma once

#include <optional>
#include <string>

#include "core/model/system.h"

namespace forage::xml {

/// Reads a system file, and the files of its linked processes, and reports every problem of its form. When
/// the rest of the file is still clear, the system is returned in spite of errors, so that model::validate()
/// can report what else is wrong. Only a system without errors in `diagnostics` can run.
std::optional<model::System> read_system(const std::string& path, Diagnostics& diagnostics);

/// Reads a text as read_system() reads a file; messages call it `path`. Links are relative to the directory
/// of `path`.
std::optional<model::System> parse_system(const std::string& path, std::string text,
                                          Diagnostics& diagnostics);

/// Reads a process file as read_system() reads a system file.
std::optional<model::ProcessFile> read_process(const std::string& path, Diagnostics& diagnostics);

}  // namespace forage::xml
