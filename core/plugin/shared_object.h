// Shared objects, and what the loader says of those that are none.
#pragma once

#include <string>

#include "core/base/diagnostic.h"

namespace forage::plugin {

/// Loads the shared object at `path` and returns the address of its `symbol`. Null when there is none, or it
/// cannot be loaded, which is reported. It stays loaded until the program ends: whatever is made of its
/// types refers to its code.
const void* load_symbol(const std::string& path, const char* symbol, Diagnostics& diagnostics);

/// A C++ name as in source code; what is none stays as it is.
std::string demangled(const std::string& name);

}  // namespace forage::plugin
