// The systems that a user opened or saved last, each with its own world and seed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace forage::studio {

/// A system with the world and the seed of its last run. Paths are absolute; without a world, `world` is
/// empty.
struct RecentFile {
    std::string file, world;
    std::uint64_t seed = 1;
};

/// Notes a system as the latest, in $XDG_STATE_HOME/forage/recent. What cannot be written is not noted.
void note_recent(const RecentFile& used);
/// At most twenty systems whose files exist, the latest first.
std::vector<RecentFile> recent_files();
/// How a system was used last; nothing when it is not among the latest.
std::optional<RecentFile> last_use(const std::string& file);

}  // namespace forage::studio
