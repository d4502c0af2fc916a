// What a saved run says about how it was opened.
#pragma once

#include <map>
#include <string>

#include <forage/forage.h>

#include "core/run/input_files.h"

namespace forage {

/// The origin of a run, for Run::opened_as: the file `system`, or the `text` of a system that was built in
/// code. Relative paths become absolute ones. `types` are those of the program (program_types.h).
std::string origin_of(const std::string& system, const std::string& text, OpenOptions options,
                      const InputFiles& files, std::map<std::string, std::string> types);

/// Says how a run was opened that restarts another one: as that one, with its own seed.
void set_origin(Run& run, const Run& restarted);

/// Opens the file `system`, or `text` as if it were that file when it is not empty. `resumed_files` are those
/// of a run that is resumed from data that the user need not trust (RunInput); otherwise null.
Run open(const std::string& system, const std::string& text, const OpenOptions& options,
         Diagnostics* warnings, const InputFiles* resumed_files = nullptr);

}  // namespace forage
