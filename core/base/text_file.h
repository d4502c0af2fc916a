// Reads text files that users name.
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

/// A file cannot be read, or its content is wrong. Holds all errors.
class FileError : public std::runtime_error {
  public:
    /// `text` is the content of the file, of which the first mebibyte is kept. what() is
    /// "path:line:column: message" of the first error, with the number of further errors.
    FileError(std::string path, std::string text, std::vector<Diagnostic> errors);
    FileError(std::shared_ptr<const SourceFile> file, std::vector<Diagnostic> errors);

    const std::shared_ptr<const SourceFile>& file() const { return file_; }
    const std::vector<Diagnostic>& errors() const { return errors_; }  ///< at least one; all are in file()

  private:
    std::shared_ptr<const SourceFile> file_;
    std::vector<Diagnostic> errors_;
};

/// The bytes of the file at `path`. Reading ends after the first NUL byte, which no text contains, so that a
/// device or a disk image does not fill the memory; the parser then finds the NUL byte. Throws FileError,
/// also when there are more than `most` bytes.
std::string read_file(const std::string& path, std::size_t most = std::size_t{128} << 20);

/// A piece of a file for a message: shortened, and without control characters.
std::string escaped(std::string_view piece);

/// The reason why the file at `path` cannot be read, as an error of the file as a whole; empty when it can.
/// The content is not checked.
std::optional<Diagnostic> why_unreadable(const std::string& path);

/// A stream of the bytes of a file of any size. Throws FileError when it cannot be read or is not a regular
/// file.
std::ifstream open_file(const std::string& path);

/// The error of a text that is not made of lines: it begins like a file of another kind, or has a NUL byte or
/// obsolete line ends. Empty when there is none. `wanted` begins the message, such as "this is not a table".
std::optional<Diagnostic> not_lines(std::string_view text, std::string_view wanted);

}  // namespace forage
