// Text files that a person names, and what is wrong with them.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace forage {

/// A file that cannot be read, or does not hold what it should: everything that is wrong with it.
class FileError : public std::runtime_error {
  public:
    struct Fault {
        int line = 0, column = 0;  ///< from 1, bytes; 0: the file as a whole
        std::string message;
        std::string hint = {};  ///< may be empty
    };

    /// what() is "path:line:column: message" of the first fault, and how many more there are.
    FileError(std::string path, std::string text, std::vector<Fault> faults);

    const std::string& path() const { return path_; }
    const std::string& text() const { return text_; }  ///< its first mebibyte, for excerpts
    const std::vector<Fault>& faults() const { return faults_; }

  private:
    std::string path_, text_;
    std::vector<Fault> faults_;
};

/// The bytes of the file at `path`. Reading ends behind the first NUL byte, which no text holds: whoever
/// parses the text finds it there, and neither a device nor a disk image fills the memory. Throws FileError,
/// also when there are more than `most` bytes.
std::string read_file(const std::string& path, std::size_t most = std::size_t{128} << 20);

/// A piece of a file for a message: shortened, and harmless on a terminal.
std::string escaped(std::string_view piece);

/// Why no file can be read at `path`, as a fault of the whole; nothing when one can. Its content is not
/// looked at.
std::optional<FileError::Fault> why_unreadable(const std::string& path);

/// What shows that a file of lines is no such text: the beginning of a file of another kind, a NUL byte, line
/// ends that no program writes any more. `wanted`: "this is no table".
std::optional<FileError::Fault> not_lines(std::string_view text, std::string_view wanted);

/// What is wrong with a word that stands where a finite number is wanted.
std::string no_number(std::string_view word);

}  // namespace forage
