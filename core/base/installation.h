// Where the files that belong to the program are.
#pragma once

#include <filesystem>

namespace forage {

/// The folder of the installation, or the build tree, that the running program is in: the one above bin/.
/// Throws std::filesystem::filesystem_error where /proc is not mounted.
inline std::filesystem::path installation() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

}  // namespace forage
