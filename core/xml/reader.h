// .iqr files -> model.
#pragma once

#include <optional>
#include <string>

#include "core/model/system.h"

namespace forage::xml {

/// Reads a system file. Reports every problem of the file; nothing is returned when there is an error.
std::optional<model::System> read_system(const std::string& path, Diagnostics& diagnostics);

/// The same for a text that a person knows as `path`.
std::optional<model::System> parse_system(std::string path, std::string text, Diagnostics& diagnostics);

}  // namespace forage::xml
