// Files that users name: what to say when they cannot be read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/base/diagnostic.h"
#include "core/base/text_file.h"

namespace forage {

/// Reports all that is wrong with a file; for one that is not there, which file may have been meant.
void report(const FileError& error, Diagnostics& diagnostics);

/// The text of the file at `path`, as read_file(); reports why there is none.
std::optional<std::string> read_file(const std::string& path, std::size_t most, Diagnostics& diagnostics);

/// Whether there is a file to read at `path`, which is named at `where`; reports why not.
bool find_file(const std::string& path, const Location& where, Diagnostics& diagnostics);

}  // namespace forage
