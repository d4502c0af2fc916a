// Processes whose content is in files of their own.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/model/system.h"

namespace forage::xml {

/// Where a file uses another one, within the uses that led to it.
struct Use {
    const Location& at;
    const Use* outer;
    std::size_t& read;  ///< bytes of all files that were used so far
};

/// Replaces the processes of a file that link others by the content of these files: at most once a file
/// without ports, whose ids are kept, and any number of times a part, which has ports. Connections to
/// ports get their groups. `is_part`: the file is a process file, not a system. Returns whether all files
/// could be taken over. `use` is how the file itself is used; null for a file that stands alone.
bool link(model::System& system, bool is_part, const Use* use, Diagnostics& diagnostics);

/// The content of a process file, as link() takes it over: the first process is that of the file.
std::optional<model::System> read_part(const std::string& path, const Use* use, Diagnostics& diagnostics);

}  // namespace forage::xml
