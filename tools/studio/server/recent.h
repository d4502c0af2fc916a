// The files that a user opened or saved last.
#pragma once

#include <string>
#include <vector>

namespace forage::studio {

/// Notes a file as the latest, in $XDG_STATE_HOME/forage/recent. What cannot be written is not noted.
void note_recent(const std::string& file);
/// The absolute paths of at most twenty files that exist, the latest first.
std::vector<std::string> recent_files();

}  // namespace forage::studio
