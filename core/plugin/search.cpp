#include "core/plugin/search.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include <fmt/format.h>

namespace forage::plugin {
namespace {

namespace fs = std::filesystem;

class Found {
  public:
    /// Adds a file, or all shared objects of a folder. Returns false when there are none.
    bool add(const fs::path& path, bool named) {
        std::error_code ignored;
        if (!fs::is_directory(path, ignored)) return add_file(path, named), true;
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(path, ignored))
            if (entry.path().extension() == ".so") files.push_back(entry.path());
        std::ranges::sort(files);
        for (const auto& file : files) add_file(file, named);
        return !files.empty();
    }
    /// Adds the shared objects of a folder, except those whose name was added from elsewhere.
    void add_others(const fs::path& folder) {
        std::set<fs::path> names;
        for (const auto& file : files_) names.insert(fs::path(file.path).filename());
        Found all;
        all.add(folder, false);
        for (const auto& file : all.files_)
            if (!names.contains(fs::path(file.path).filename())) add_file(file.path, false);
    }
    std::vector<File> files() && { return std::move(files_); }

  private:
    void add_file(const fs::path& path, bool named) {
        std::error_code ignored;
        if (seen_.insert(fs::weakly_canonical(path, ignored)).second)
            files_.push_back({path.string(), named});
    }
    std::vector<File> files_;
    std::set<fs::path> seen_;
};

/// The source file of a plugin that 'forage build-plugin' or CMake has made in the folder "plugins", if it
/// has been changed since; empty otherwise.
fs::path newer_source(const fs::path& plugin) {
    std::error_code failed;
    const auto built = fs::last_write_time(plugin, failed);
    if (failed || plugin.extension() != ".so" || plugin.parent_path().filename() != "plugins") return {};
    const fs::path beside = plugin.parent_path().parent_path();
    for (const auto& folder : {beside, beside.parent_path()}) {
        fs::path source = folder / plugin.stem();
        source += ".cpp";
        const auto changed = fs::last_write_time(source, failed);
        if (!failed && changed > built) return source;
    }
    return {};
}

}  // namespace

std::vector<File> find(const std::vector<std::string>& named, const std::string& path,
                       const std::string& beside, Diagnostics& diagnostics, bool by_user) {
    Found found;
    std::error_code ignored;
    for (const auto& name : named)
        if (!found.add(name, by_user))  // load() reports files that do not exist
            diagnostics.warning({}, fmt::format("--plugin: there is no plugin in the folder '{}'", name),
                                "plugins end in .so; 'forage build-plugin FILE.cpp' makes one");
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, ':');) {
        if (part.empty()) continue;
        if (fs::exists(part, ignored))
            found.add(part, true);
        else
            diagnostics.warning({}, fmt::format("FORAGE_PLUGIN_PATH: there is no '{}'", part));
    }
    if (!beside.empty())
        if (const auto folder = fs::path(beside).parent_path() / "plugins"; fs::is_directory(folder, ignored))
            found.add_others(folder);
    auto files = std::move(found).files();
    for (const auto& file : files)
        if (const auto source = newer_source(file.path); !source.empty())
            diagnostics.warning({}, fmt::format("plugin '{}' is older than '{}'", file.path, source.string()),
                                fmt::format("'forage build-plugin {}' builds it again", source.string()));
    return files;
}

}  // namespace forage::plugin
