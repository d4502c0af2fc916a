// Searches for plugins.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::plugin {

/// A shared object that was found.
struct File {
    std::string path;
    bool named = true;  ///< by the user, in this command or call or in FORAGE_PLUGIN_PATH
};

/// The shared objects to load, each of them once, in this order:
///
///   named    files and folders that the user named, or a file unless `by_user`; a missing one is an error
///   path     FORAGE_PLUGIN_PATH: files and folders separated by colons; a missing one is a warning
///   beside   the folder "plugins" beside this file, if it exists, without files whose name was found
///            before; no folder when empty
///
/// Warns of a plugin in a folder "plugins" whose source file, NAME.cpp beside this folder or one above, is
/// newer. A folder stands for all its files *.so, in byte order of their names.
std::vector<File> find(const std::vector<std::string>& named, const std::string& path,
                       const std::string& beside, Diagnostics& diagnostics, bool by_user = true);

}  // namespace forage::plugin
