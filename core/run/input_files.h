// Which files decide a run, and whether they have changed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage {

/// Digests of files by path.
using InputFiles = std::map<std::string, std::string>;

/// The files of a system: its own, and those of linked processes.
InputFiles system_files(const model::System& system);

/// The files that parameters of modules name: in the system, in --set, or in a change to come. Modules read them, or write
/// them when they are asked to.
std::vector<std::string> module_files(const model::System& system, const Registry& registry,
                                      const std::vector<model::Assignment>& changes);

/// The digest of a file's content; of a path that is no file, the digest of nothing.
std::string file_digest(const std::string& path);

}  // namespace forage
