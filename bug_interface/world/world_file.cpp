#include "bug_interface/world/world_file.h"

#include <filesystem>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace forage::bug {

namespace fs = std::filesystem;

bool is_a_folder(const std::string& path, Diagnostics& diagnostics) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) return false;
    std::set<std::string> worlds;
    for (fs::directory_iterator entry(path, ignored), end; !ignored && entry != end; entry.increment(ignored))
        if (entry->path().extension() == ".world") worlds.insert(entry->path().string());
    diagnostics.error({std::make_shared<SourceFile>(SourceFile{path, {}}), 0, 0},
                      "this is a folder, not a world file",
                      worlds.empty() ? "give the path of a .world file"
                                     : fmt::format("in it are {}", fmt::join(worlds, ", ")));
    return true;
}

}  // namespace forage::bug
