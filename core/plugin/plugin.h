// Types from shared objects.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/plugin/search.h"
#include "core/types/plugin.h"
#include "core/types/registry.h"

namespace forage::plugin {

/// The types of a shared object.
struct Plugin {
    std::string path;  ///< as given or found
    PluginTypes types;
    bool loaded = true;     ///< whether its code is in this program; if not, the types are only declared
    std::string hint = {};  ///< what makes its types known; empty when they are
};

/// What is done with a system.
enum class Use { read, run };

/// The plugins among `files` that have no mistakes, in the same order. A file that the user has named is
/// loaded. Another one is loaded to run a system, if its folder is trusted (trust.h); to read a system, the
/// declarations beside it are read instead (declarations.h), so that reading a system never runs code that is
/// beside it.
///
/// Reports plugins that other users may change, a wrong version of the SDK or of the ABI, names that
/// `shipped` or another plugin already has, types that throw when they are described or created, and updates
/// that break their declaration.
std::vector<Plugin> load(const std::vector<File>& files, Use use, const Registry& shipped,
                         Diagnostics& diagnostics);

/// Adds the types of all plugins to the registry, and the folders of those that are not known.
void add(const std::vector<Plugin>& plugins, Registry& registry);

/// Makes a crash of this program (SIGSEGV, SIGBUS, SIGFPE, SIGILL) name on stderr which of the plugins at
/// `paths` it happened in, before the program ends as without this function. Does nothing without plugins.
void tell_crashes(const std::vector<std::string>& paths);

}  // namespace forage::plugin
