// Signals that stop a run after the current cycle.
#pragma once

#include <cstdint>
#include <string>

namespace forage::tool {

/// Makes the program only note the first SIGINT or SIGTERM, and say on stderr that it finishes `what`. The
/// second one ends it.
void note_signals(const char* what);
/// Adds the number of a cycle to `what`.
void note_cycle(std::uint64_t cycle);
/// The signal that was noted; 0 for none.
int noted_signal();

/// The end of a sentence about a signal: "by Ctrl-C" or "by SIGTERM".
std::string stopped_by(int signal);

}  // namespace forage::tool
