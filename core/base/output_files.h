// Files that are there whole or not at all.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// Throws std::runtime_error when what stands at `path` is no file, but a directory or a device: a file would
/// take its place, or could not.
void refuse_no_file(const std::string& path);
/// Tells, before any work is done, what keeps a file from being written at `path`: its directory is missing
/// or may not be written, or what stands there is no file. `example`: a name, for the hint.
void check_output(const std::string& path, const std::string& example, Diagnostics& diagnostics);
/// The name under which a file grows; rename it with finish().
std::string partial(const std::string& path);
/// Gives a file that was written as partial(path) its name. Throws std::runtime_error.
void finish(const std::string& path);
/// Removes the results that a program left unfinished in a directory when it was killed, under names that
/// partial() gives them. Returns these names.
std::vector<std::string> remove_unfinished(const std::string& directory);
/// Writes `text` to `path` by way of partial(path). Throws std::runtime_error.
void write_file(const std::string& path, std::string_view text);
/// The same, and makes sure that the file survives a power cut. What was there before gets the name `keep`,
/// if that is not empty.
void write_durably(const std::string& path, std::string_view text, const std::string& keep = {});
/// Makes sure that what was written to a file, and its name, survive a power cut. Throws std::runtime_error.
void flush_to_disk(const std::string& path);
/// 64-bit FNV-1a in hexadecimal digits: tells whether a text has changed.
std::string digest(std::string_view text);
/// Makes a directory and those above it. Throws std::runtime_error, also when it is there and cannot be
/// written.
void make_directory(const std::string& path);
/// What to do about a directory that is held.
inline constexpr const char* held_hint = "wait until it has ended, or choose another directory with -o";
/// A directory of results that this program alone writes into, for as long as this lives. The system lets go
/// of it when the program is killed; it leaves no file. Where the file system cannot do it, nothing is held.
class DirectoryHold {
  public:
    DirectoryHold() = default;  ///< of nothing
    /// Throws std::runtime_error when another program holds it.
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
