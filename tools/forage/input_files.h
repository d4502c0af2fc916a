// Which files decide a run, and whether they are still what they were.
#pragma once

#include <map>
#include <string>

#include "tools/forage/commands.h"

namespace forage::tool {

/// Digests by path.
using InputFiles = std::map<std::string, std::string>;

/// Of a system's files.
InputFiles system_files(const Sources& sources);
/// Of what a world is made of, its own file apart.
InputFiles world_files(const Sources& sources);
/// Of all that a run reads before it starts: system, world, tables, patterns, files that modules are given.
InputFiles input_files(const RunOptions& options, const Sources& sources, const Loaded& loaded);

/// Digest of a file's content.
std::string file_digest(const std::string& path);

}  // namespace forage::tool
