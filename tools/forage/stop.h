// Signals that stop a run after the current cycle.
#pragma once

#include <string>

namespace forage::tool {

/// Makes the program only note the first SIGINT or SIGTERM. The second one ends it.
void note_signals();
/// The signal that was noted; 0 for none.
int noted_signal();

/// The end of a sentence about a signal: "by Ctrl-C" or "by SIGTERM".
std::string stopped_by(int signal);

}  // namespace forage::tool
