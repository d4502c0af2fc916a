// Ctrl-C and kill: finish the cycle, then stop in order.
#pragma once

namespace forage::tool {

/// From now on SIGINT and SIGTERM are noted instead of ending the program at once; a second one ends it.
void note_signals();
/// The signal that was noted, 0 for none.
int noted_signal();

}  // namespace forage::tool
