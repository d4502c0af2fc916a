// Reports about files that users name and that cannot be read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/base/diagnostic.h"
#include "core/base/text_file.h"

namespace forage {

/// Reports all errors of a file. For a missing file, the hint names a file with a similar name.
void report(const FileError& error, Diagnostics& diagnostics);

/// The text of the file at `path`, as read_file() returns it. Reports an error and returns nothing when it
/// cannot be read.
std::optional<std::string> read_file(const std::string& path, std::size_t most, Diagnostics& diagnostics);

/// Whether the file at `path`, which is named at `where`, can be read. Reports an error when it cannot.
bool find_file(const std::string& path, const Location& where, Diagnostics& diagnostics);

}  // namespace forage
