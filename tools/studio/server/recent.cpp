#include "tools/studio/server/recent.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/output_files.h"
#include "tools/studio/server/recovery.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_recent = 20;

std::string list_path() { return state_home() + "/forage/recent"; }

std::string full_path(const std::string& file) {
    return file.empty() ? file : fs::weakly_canonical(fs::absolute(file)).string();
}

}  // namespace

// A line has the file, the world and the seed, with tabs between them; earlier versions wrote the file alone.
std::vector<RecentFile> recent_files() {
    std::vector<RecentFile> out;
    try {
        std::ifstream list(list_path());
        std::error_code ignored;
        for (std::string line; out.size() < max_recent && std::getline(list, line);) {
            std::istringstream in(line);
            RecentFile used;
            std::string seed;
            std::getline(in, used.file, '\t'), std::getline(in, used.world, '\t'), std::getline(in, seed);
            used.seed = parse_number<std::uint64_t>(seed).value_or(1);
            if (fs::is_regular_file(used.file, ignored)) out.push_back(std::move(used));
        }
    } catch (const std::exception&) {  // without a home there is no list
    }
    return out;
}

void note_recent(const RecentFile& used) {
    try {
        const RecentFile now{full_path(used.file), full_path(used.world), used.seed};
        if ((now.file + now.world).find_first_of("\n\t") != std::string::npos) return;
        const auto line = [](const RecentFile& r) {
            return fmt::format("{}\t{}\t{}\n", r.file, r.world, r.seed);
        };
        std::string text = line(now);
        for (const auto& other : recent_files())
            if (other.file != now.file) text += line(other);
        write_file(state_folder() + "/recent", text);
    } catch (const std::exception&) {  // the list is a convenience
    }
}

std::optional<RecentFile> last_use(const std::string& file) {
    std::error_code ignored;
    for (const auto& used : recent_files())
        if (fs::equivalent(used.file, file, ignored)) return used;
    return std::nullopt;
}

}  // namespace forage::studio
