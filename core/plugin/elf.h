// Checks a file before the dynamic loader opens it, because the loader crashes on some broken files.
#pragma once

#include <string>

namespace forage::plugin {

/// The reason why the file at `path` is not a shared object for this computer, as the end of a sentence: "is
/// not a shared object". Empty when the file looks like one.
std::string why_not_loadable(const std::string& path);

}  // namespace forage::plugin
