// Writes models as .iqr and .iqrProcess files.
#pragma once

#include <string>

#include "core/model/system.h"

namespace forage::xml {

/// The text of a system file. Reading it gives an equal system, and writing that system gives the same text.
/// For a linked process only the link is written, as its content has a file of its own.
std::string write_system(const model::System& system);

/// The text of a process file: a process and the connections among its groups.
std::string write_process(const model::ProcessFile& file);

}  // namespace forage::xml
