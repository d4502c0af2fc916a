#include "bug_interface/world/world_file.h"

#include <filesystem>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bug_interface/world/model_folders.h"

namespace forage::bug {

namespace {

namespace fs = std::filesystem;

/// The name of the first element of an XML text; empty when there is none.
std::string root_name(std::string_view text) {
    for (;;) {
        const auto open = text.find('<');
        if (open == std::string_view::npos) return {};
        text.remove_prefix(open + 1);
        if (!text.starts_with('!') && !text.starts_with('?'))
            return std::string(text.substr(0, text.find_first_of(" \t\r\n/>")));
        const std::string_view end = text.starts_with("!--") ? "-->" : ">";
        const auto close = text.find(end);
        if (close == std::string_view::npos) return {};
        text.remove_prefix(close + end.size());
    }
}

}  // namespace

bool looks_like_a_world(const std::string& path, Diagnostics& diagnostics) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        std::set<std::string> worlds;
        for (fs::directory_iterator entry(path, ignored), end; !ignored && entry != end;
             entry.increment(ignored))
            if (entry->path().extension() == ".world") worlds.insert(entry->path().string());
        diagnostics.error({}, fmt::format("'{}' is a folder, not a world file", path),
                          worlds.empty() ? "give the path of a .world file"
                                         : fmt::format("in it are {}", fmt::join(worlds, ", ")));
        return false;
    }
    const auto text = read_text(path);
    if (!text) {
        diagnostics.error({}, fmt::format("cannot read the world file '{}'", path), "is the path right?");
        return false;
    }
    const bool png = text->starts_with("\x89PNG");
    if (png || text->substr(0, 1000).find('\0') != std::string::npos) {
        diagnostics.error(
            {}, fmt::format("'{}' is {}, not a world file", path, png ? "a PNG picture" : "a binary file"),
            "a world is a text file: SDF, an XML format");
        return false;
    }
    if (text->find_first_not_of(" \t\r\n") == std::string::npos) {
        diagnostics.error({}, fmt::format("the world file '{}' is empty", path));
        return false;
    }
    const std::string root = root_name(*text);
    const Location file{std::make_shared<SourceFile>(SourceFile{path, {}}), 0, 0};
    if (root == "System")
        diagnostics.error(
            file, "this is a system file; a world is wanted here",
            "a world is an SDF file, with the ending .world: the robot, its arena and the lights");
    else if (root.empty())
        diagnostics.error(file, "there is no XML in this file",
                          "a world is an SDF file, with the ending .world");
    else if (root != "sdf" && root != "gazebo")
        diagnostics.error(file, fmt::format("the root element is <{}>; that of a world is <sdf>", root));
    else
        return true;
    return false;
}

}  // namespace forage::bug
