// Loads shared objects.
#pragma once

#include <string>

#include "core/base/diagnostic.h"

namespace forage::plugin {

/// Loads the shared object at `path` and returns the address of its `symbol`. Reports an error and returns
/// null when other users may change the object, when it cannot be loaded, and when it has no such symbol. It
/// stays loaded until the program ends, because objects of its types refer to its code.
const void* load_symbol(const std::string& path, const char* symbol, Diagnostics& diagnostics);

/// Whether this program has loaded the shared object before.
bool is_loaded(const std::string& path);

/// A C++ name as in source code. A text that is not a mangled name is returned unchanged.
std::string demangled(const std::string& name);

}  // namespace forage::plugin
