// The pictures that a run leaves behind.
#pragma once

#include <string>
#include <vector>

#include "tools/forage/running.h"

namespace forage::tool {

/// Draws the plots that were asked for and, where robots were followed, their paths (with the table
/// trajectory.csv) into the run's directory: `outcome` gets the names of the files. To be called after
/// note(). What cannot be drawn does not keep the rest from being drawn. Returns what went wrong.
std::vector<std::string> write_pictures(const RunOptions& options, const Running& running, Outcome& outcome);

}  // namespace forage::tool
