// Where the files that belong to the program are.
#pragma once

#include <filesystem>

namespace forage {

/// The file that Forage runs in: the program, or the module of Python once that has put its own path here.
inline std::filesystem::path& running_file() {
    static std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe");
    return file;
}

/// The folder of the installation, of the build tree or of the package of Python: the nearest one above the
/// running file that holds share/forage, and otherwise the one above bin/. Throws
/// std::filesystem::filesystem_error where /proc is not mounted.
inline std::filesystem::path installation() {
    const auto above = running_file().parent_path();
    std::error_code ignored;
    for (auto folder = above; folder.has_relative_path(); folder = folder.parent_path())
        if (std::filesystem::exists(folder / "share/forage", ignored)) return folder;
    return above.parent_path();
}

}  // namespace forage
