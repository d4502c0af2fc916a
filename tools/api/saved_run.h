// What a saved run says about how it was opened.
#pragma once

#include <string>

#include <forage/forage.h>

#include "core/run/input_files.h"

namespace forage {

/// The origin of a run, for Run::opened_as: the file `system`, or the `text` of a system that was built in
/// code. Relative paths become absolute ones.
std::string origin_of(const std::string& system, const std::string& text, OpenOptions options,
                      const InputFiles& files);

/// Opens the file `system`, or `text` as if it were that file when it is not empty.
Run open(const std::string& system, const std::string& text, const OpenOptions& options,
         Diagnostics* warnings);

}  // namespace forage
