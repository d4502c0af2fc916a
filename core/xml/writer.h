// model -> .iqr and .iqrProcess files.
#pragma once

#include <string>

#include "core/model/system.h"

namespace forage::xml {

/// The text of a system file. Reading it gives an equal system; writing that gives the same text. Of a linked
/// process only the link is written: its content lives in its own file.
std::string write_system(const model::System& system);

/// The text of a process file: a process and the connections among its groups.
std::string write_process(const model::ProcessFile& file);

}  // namespace forage::xml
