// What a saved run says about how it was opened.
#pragma once

#include <string>

#include <forage/forage.h>

#include "core/run/input_files.h"

namespace forage {

/// The origin of a run from files, for Run::opened_as. Relative paths become absolute ones.
std::string origin_of(const std::string& system, OpenOptions options, const InputFiles& files);

}  // namespace forage
