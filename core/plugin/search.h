// Where plugins are.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::plugin {

/// The shared objects that are to be loaded, each once, in this order:
///
///   named    files and folders that somebody named; one that does not exist is reported
///   path     FORAGE_PLUGIN_PATH: files and folders between colons; one that does not exist gives a warning
///   beside   the folder "plugins" beside this file, if it is there, without those whose name one of the
///   others
///            has; no file when empty
///
/// Of a folder all files *.so, in byte order of their names.
std::vector<std::string> find(const std::vector<std::string>& named, const std::string& path,
                              const std::string& beside, Diagnostics& diagnostics);

}  // namespace forage::plugin
