// A message for a program that crashes in a plugin.
#pragma once

#include <string>
#include <vector>

namespace forage::plugin {

/// Makes a crash of this program (SIGSEGV, SIGBUS, SIGFPE, SIGILL) name on stderr which of the plugins at
/// `paths` it happened in, before the program ends as without this function. Does nothing without plugins.
void tell_crashes(const std::vector<std::string>& paths);

}  // namespace forage::plugin
