// The types of a plugin as a file beside it, so that systems are checked and shown without its code.
#pragma once

#include <optional>
#include <string>

#include "core/types/plugin.h"

namespace forage::plugin {

/// The file with the declarations of a plugin: NAME.so.json.
std::string declarations_path(const std::string& plugin);

/// The declarations of `types`, which the shared object `plugin` holds, as JSON. They have no code: checks of
/// parameters and rules for the sizes of groups are left out.
std::string declarations(const PluginTypes& types, const std::string& plugin);

/// The types that are declared beside a plugin. They can be checked and laid out; their updates throw
/// std::logic_error. Empty when there are no declarations, and when they are damaged, of another SDK or of
/// another build of the plugin.
std::optional<PluginTypes> read_declarations(const std::string& plugin);

}  // namespace forage::plugin
