// What the files that a run leaves behind will be called.
#pragma once

#include <string>
#include <vector>

#include "tools/forage/running.h"

namespace forage::tool {

/// Within the run's directory; those of pictures and films only as far as their names can be known.
std::vector<std::string> result_names(const RunOptions& options, const Running& running);

/// Throws std::runtime_error when one of them cannot be written because something else has its name: what is
/// known before the run should not be found out after it.
void check_result_names(const RunOptions& options, const Running& running);

}  // namespace forage::tool
