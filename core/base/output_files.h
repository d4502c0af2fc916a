// Output files, which are complete or absent.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// Throws std::runtime_error when `path` is a directory or a device instead of a file.
void check_regular_file(const std::string& path);
/// Reports, before any work is done, why a file cannot be written at `path`: its directory is missing or not
/// writable, or `path` is not a file. `example` is a file name for the hint.
void check_output(const std::string& path, const std::string& example, Diagnostics& diagnostics);
/// The temporary name under which a file grows, until finish() renames it.
std::string partial(const std::string& path);
/// Renames partial(path) to `path`. Throws std::runtime_error.
void finish(const std::string& path);
/// Removes the files with names of partial() that a killed program left in a directory. Returns their names.
std::vector<std::string> remove_unfinished(const std::string& directory);
/// Writes `text` to partial(path) and renames it to `path`; a symbolic link stays one. Throws
/// std::runtime_error.
void write_file(const std::string& path, std::string_view text);
/// Writes `text` to partial(path) and renames it to `path`, where a symbolic link is replaced: the directory
/// of results may come from another person, and its links lead to any file. Throws std::runtime_error.
void write_result(const std::string& path, std::string_view text);
/// Writes `text` to `path` as write_result() does, and makes sure that the file survives a power cut. An
/// existing file is renamed to `keep`, unless that is empty.
void write_durably(const std::string& path, std::string_view text, const std::string& keep = {});
/// Makes sure that the content and the name of a file survive a power cut. Throws std::runtime_error.
void flush_to_disk(const std::string& path);
/// Creates a directory and its parents. Throws std::runtime_error, also when the directory exists and is not
/// writable.
void make_directory(const std::string& path);
/// The hint for a directory that another program has locked.
inline constexpr const char* held_hint = "wait until it has ended, or choose another directory with -o";
/// A lock on a directory of results, for the lifetime of this object. The system releases it when the program
/// is killed, and it leaves no file. On file systems without locks it has no effect.
class DirectoryHold {
  public:
    DirectoryHold() = default;  ///< locks nothing
    /// Locks the directory. Throws std::runtime_error when another program has locked it.
    explicit DirectoryHold(const std::string& directory);
    DirectoryHold(DirectoryHold&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    DirectoryHold& operator=(DirectoryHold&& other) noexcept { return std::swap(file_, other.file_), *this; }
    ~DirectoryHold();

  private:
    int file_ = -1;
};
/// `text` with everything but letters, digits, '.', '-' and '_' replaced by '_'.
std::string file_name(std::string_view text);

}  // namespace forage
