// The folders in which tests find files.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace forage::test {

inline std::filesystem::path source_dir() { return FORAGE_SOURCE_DIR; }

/// The recorded traces and files of the original: $FORAGE_SHARED, or `shared` beside the project. May be
/// absent.
inline std::filesystem::path shared_dir() {
    if (const char* given = std::getenv("FORAGE_SHARED")) return given;
    return source_dir().parent_path() / "shared";
}

/// A path for temporary files of this process.
inline std::filesystem::path temporary_path(const std::string& name) {
    return std::filesystem::temp_directory_path() / (name + "-" + std::to_string(::getpid()));
}

/// When `path` is absent, prints that a test has nothing to read, and returns true.
inline bool absent(const std::filesystem::path& path) {
    if (std::filesystem::exists(path)) return false;
    std::fprintf(stderr, "SKIPPED: '%s' is absent (recorded data of the original; see docs/design.md)\n",
                 path.c_str());
    return true;
}

}  // namespace forage::test
