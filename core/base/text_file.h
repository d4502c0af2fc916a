// Text files that users name, and what is wrong with them.
#pragma once

#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// A file that cannot be read, or does not hold what it should: everything that is wrong with it.
class FileError : public std::runtime_error {
  public:
    /// `text` is the content of the file, of which the first mebibyte is kept. what() is
    /// "path:line:column: message" of the first error, and how many more there are.
    FileError(std::string path, std::string text, std::vector<Diagnostic> errors);
    FileError(std::shared_ptr<const SourceFile> file, std::vector<Diagnostic> errors);

    const std::shared_ptr<const SourceFile>& file() const { return file_; }
    const std::vector<Diagnostic>& errors() const { return errors_; }  ///< at least one; all are in file()

  private:
    std::shared_ptr<const SourceFile> file_;
    std::vector<Diagnostic> errors_;
};

/// The bytes of the file at `path`. Reading ends behind the first NUL byte, which no text holds: whoever
/// parses the text finds it there, and neither a device nor a disk image fills the memory. Throws FileError,
/// also when there are more than `most` bytes.
std::string read_file(const std::string& path, std::size_t most = std::size_t{128} << 20);

/// A piece of a file for a message: shortened, and harmless on a terminal.
std::string escaped(std::string_view piece);

/// Why no file can be read at `path`, as an error of the file as a whole; nothing when one can. The content
/// is not looked at.
std::optional<Diagnostic> why_unreadable(const std::string& path);

/// A stream of the bytes of a file of any size. Throws FileError when it cannot be read or is no regular
/// file.
std::ifstream open_file(const std::string& path);

/// What shows that a file of lines is no such text: the beginning of a file of another kind, a NUL byte, line
/// ends that no program writes any more. `wanted`: "this is no table".
std::optional<Diagnostic> not_lines(std::string_view text, std::string_view wanted);

}  // namespace forage
