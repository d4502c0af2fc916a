// Types from shared objects.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/types/plugin.h"
#include "core/types/registry.h"

namespace forage::plugin {

/// The types of a shared object.
struct Plugin {
    std::string path;  ///< as given or found
    PluginTypes types;
};

/// Loads the shared objects at `paths`. Reports a wrong version of the SDK or of the ABI, names that
/// `shipped` or another plugin already has, types that throw when they are described or created, and updates
/// that break their declaration. The result holds the plugins without mistakes, which can be added to
/// `shipped`.
std::vector<Plugin> load(const std::vector<std::string>& paths, const Registry& shipped,
                         Diagnostics& diagnostics);

/// Adds the types of all plugins to the registry.
void add(const std::vector<Plugin>& plugins, Registry& registry);

/// Makes a crash of this program (SIGSEGV, SIGBUS, SIGFPE, SIGILL) name on stderr which of the plugins at
/// `paths` it happened in, before the program ends as without this function. Does nothing without plugins.
void tell_crashes(const std::vector<std::string>& paths);

}  // namespace forage::plugin
