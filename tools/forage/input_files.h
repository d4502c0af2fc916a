// Which files decide a run, and whether they are still what they were.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/observe/schedule.h"
#include "tools/forage/commands.h"

namespace forage::tool {

/// Digests by path.
using InputFiles = std::map<std::string, std::string>;

/// Of a system's files.
InputFiles system_files(const Sources& sources);
/// Of what a world is made of, its own file apart.
InputFiles world_files(const Sources& sources);
/// Of all that a run reads before it starts: system, world, tables, patterns.
InputFiles input_files(const RunOptions& options, const Sources& sources);

/// The files that modules are given: by the system, --set, or a change to come (--at). Modules read them, or
/// write them, when they are asked to.
std::vector<std::string> module_files(const Loaded& loaded, const observe::Schedule& schedule);

/// Digest of a file's content; of what is no file, or not there, that of nothing.
std::string file_digest(const std::string& path);

}  // namespace forage::tool
