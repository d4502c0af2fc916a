// The files that decide a run, and their digests.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/digest.h"
#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage {

/// SHA-256 digests of files by path.
using InputFiles = std::map<std::string, std::string>;
/// Contents of files by path.
using FileTexts = std::map<std::string, std::string>;

/// The files of a system: its own, those of linked processes, and those of arrays.
InputFiles system_files(const model::System& system);

/// The files that parameters of modules name: in the system, in --set, or in a scheduled change. Modules read
/// or write these files.
std::vector<std::string> module_files(const model::System& system, const Registry& registry,
                                      const std::vector<model::Assignment>& changes);

}  // namespace forage
