// Searches for plugins.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::plugin {

/// The shared objects to load, each of them once, in this order:
///
///   named    files and folders that the user named; a missing one is an error
///   path     FORAGE_PLUGIN_PATH: files and folders separated by colons; a missing one is a warning
///   beside   the folder "plugins" beside this file, if it exists, without files whose name was found
///            before; no folder when empty
///
/// Warns of a plugin in a folder "plugins" whose source file, NAME.cpp beside this folder or one above, is
/// newer. A folder stands for all its files *.so, in byte order of their names.
std::vector<std::string> find(const std::vector<std::string>& named, const std::string& path,
                              const std::string& beside, Diagnostics& diagnostics);

}  // namespace forage::plugin
