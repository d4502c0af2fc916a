// Compiles types of users to plugins.
#pragma once

#include <string>

namespace forage {

struct PluginBuild {
    std::string source;             ///< the file (.cpp)
    std::string output = {};        ///< the plugin to write; empty: the folder plugins beside the source
    bool debug = false;             ///< for a debugger; each index is checked
    std::string installation = {};  ///< the folder with the headers and libraries of Forage, such as /usr
    /// Whether the compiler's messages become diagnostics. Otherwise it writes them on the standard error.
    bool collect = false;
};

/// Compiles a source file to a plugin, with the compiler in CXX or else c++ and the options in CXXFLAGS, and
/// checks that it can be loaded. Writes its declarations beside it (core/plugin/declarations.h). Returns the
/// path of the plugin. Throws InputError, and std::runtime_error when a folder cannot be made; nothing new is
/// left behind then.
std::string build_plugin(const PluginBuild& build);

/// The nearest folder above `path` that holds headers and libraries for plugins; empty when there is none.
std::string installation_above(const std::string& path);

}  // namespace forage
