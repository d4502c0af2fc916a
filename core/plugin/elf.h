// A look into a file before the loader gets it, which crashes on some that are broken.
#pragma once

#include <string>

namespace forage::plugin {

/// Why the file at `path` is no shared object for this computer, as the end of a sentence: "is not a shared
/// object"; empty when it looks like one.
std::string why_not_loadable(const std::string& path);

}  // namespace forage::plugin
