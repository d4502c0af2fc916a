#include "tools/studio/server/recent.h"

#include <exception>
#include <filesystem>
#include <fstream>

#include "core/base/output_files.h"
#include "tools/studio/server/recovery.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_recent = 20;

std::string list_path() { return state_home() + "/forage/recent"; }

}  // namespace

std::vector<std::string> recent_files() {
    std::vector<std::string> out;
    try {
        std::ifstream list(list_path());
        std::error_code ignored;
        for (std::string line; out.size() < most_recent && std::getline(list, line);)
            if (fs::is_regular_file(line, ignored)) out.push_back(line);
    } catch (const std::exception&) {  // without a home there is no list
    }
    return out;
}

void note_recent(const std::string& file) {
    try {
        const std::string whole = fs::weakly_canonical(fs::absolute(file)).string();
        if (whole.find('\n') != whole.npos) return;  // a line of the list is a path
        std::string text = whole + "\n";
        for (const auto& other : recent_files())
            if (other != whole) text += other + "\n";
        write_file(state_folder() + "/recent", text);
    } catch (const std::exception&) {  // the list is a convenience
    }
}

}  // namespace forage::studio
