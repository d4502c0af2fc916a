// Ctrl-C and kill: finish the cycle, then stop in order.
#pragma once

#include <string>

namespace forage::tool {

/// From now on SIGINT and SIGTERM are noted instead of ending the program at once; a second one ends it.
void note_signals();
/// The signal that was noted, 0 for none.
int noted_signal();

/// "by Ctrl-C", "by SIGTERM"
std::string stopped_by(int signal);

}  // namespace forage::tool
