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
    std::string path;  ///< as found
    PluginTypes types;
};

/// Loads the shared objects at `paths` and checks what they declare: the SDK's version, the ABI, names that
/// `shipped` or another plugin has, types that throw when they are described or made, states that do not fit.
/// All mistakes are reported; what is returned can be added to `shipped`.
std::vector<Plugin> load(const std::vector<std::string>& paths, const Registry& shipped,
                         Diagnostics& diagnostics);

/// Adds the types of all plugins.
void add(const std::vector<Plugin>& plugins, Registry& registry);

}  // namespace forage::plugin
