// Diagnostics: every problem of a file in one run, each written for the person who made the mistake.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace forage {

/// A file that a person edits, as it was read.
struct SourceFile {
    std::string path;  ///< as given by the person
    std::string text;
};

/// A place in a file. `line` and `column` count from 1 (bytes); 0: the file as a whole. No file: a command
/// line.
struct Location {
    std::shared_ptr<const SourceFile> file;
    int line = 0;
    int column = 0;

    /// Where something stands is not part of what it says: models that say the same are equal.
    friend bool operator==(const Location&, const Location&) { return true; }
};

enum class Severity { error, warning };

struct Diagnostic {
    Severity severity = Severity::error;
    Location where;
    std::string message;
    std::string hint;  ///< what to do about it; may be empty
};

/// Collects diagnostics; nothing is thrown. Of very many it keeps the first thousand and counts the rest.
class Diagnostics {
  public:
    void error(Location where, std::string message, std::string hint = {});
    void warning(Location where, std::string message, std::string hint = {});
    /// Something unknown that the original would ignore: an error, or under `lenient` a warning.
    void unknown(Location where, std::string message, std::string hint = {});

    bool failed() const { return errors_ > 0; }
    int errors() const { return errors_; }
    int warnings() const { return warnings_; }
    const std::vector<Diagnostic>& all() const { return all_; }

    bool lenient = false;

  private:
    void add(Severity severity, Location where, std::string message, std::string hint);

    std::vector<Diagnostic> all_;
    int errors_ = 0, warnings_ = 0;
};

/// Where the byte `offset` of a file stands.
Location location_of(std::shared_ptr<const SourceFile> file, std::size_t offset);

/// `file:line:column: error: message`, the line with a caret under the column, `hint: ...`.
std::string format(const Diagnostic& diagnostic);
/// All of them, in order of file position; of very many only the first fifty.
std::string format(const Diagnostics& diagnostics);

/// The candidate nearest to `name` (edit distance, case ignored), or one that begins with it; empty when none
/// does.
std::string_view nearest(std::string_view name, std::span<const std::string> candidates);
/// "did you mean 'x'?", or the list of what there is when nothing is near; empty without candidates.
std::string suggest(std::string_view name, std::span<const std::string> candidates);

}  // namespace forage
