// Diagnostics: every problem of a file in one run, each written for the author of the file. Plugins report
// with the classes, which are complete in this header; the functions need the library.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace forage {

/// A file that users edit, as it was read.
struct SourceFile {
    std::string path;  ///< as the user gave it
    std::string text;  ///< may end early: excerpts are all that it serves
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

/// What the check() of a type points at. Types know names and not places in a file: validation finds the
/// place.
struct Subject {
    Subject(std::string parameter_name, std::string port_name)
        : parameter(std::move(parameter_name)), port(std::move(port_name)) {}
    std::string parameter;  ///< a parameter of the type; empty for none
    std::string port;       ///< a cross reference of a module type; empty for none
};
inline Subject at_parameter(std::string name) { return {std::move(name), {}}; }
inline Subject at_port(std::string name) { return {{}, std::move(name)}; }

/// One problem of a file or of a command line.
struct Diagnostic {
    Severity severity = Severity::error;
    Location where;
    std::string message;
    std::string hint;             ///< what to do about it; may be empty
    std::string parameter, port;  ///< as in Subject, until the place is known
};

/// An error in a file that the caller names later. `line` and `column` as in Location.
inline Diagnostic error_at(int line, int column, std::string message, std::string hint = {}) {
    return {Severity::error, {nullptr, line, column}, std::move(message), std::move(hint), {}, {}};
}

/// Collects diagnostics; nothing is thrown. Of very many it keeps the first thousand and counts the rest.
class Diagnostics {
  public:
    void error(Location where, std::string message, std::string hint = {}) {
        add({Severity::error, std::move(where), std::move(message), std::move(hint), {}, {}});
    }
    void warning(Location where, std::string message, std::string hint = {}) {
        add({Severity::warning, std::move(where), std::move(message), std::move(hint), {}, {}});
    }
    /// The same for the check() of a type.
    void error(Subject about, std::string message, std::string hint = {}) {
        add({Severity::error,
             {},
             std::move(message),
             std::move(hint),
             std::move(about.parameter),
             std::move(about.port)});
    }
    void warning(Subject about, std::string message, std::string hint = {}) {
        add({Severity::warning,
             {},
             std::move(message),
             std::move(hint),
             std::move(about.parameter),
             std::move(about.port)});
    }
    /// Something unknown that the original would ignore: an error, or under `lenient` a warning.
    void unknown(Location where, std::string message, std::string hint = {}) {
        add({lenient ? Severity::warning : Severity::error,
             std::move(where),
             std::move(message),
             std::move(hint),
             {},
             {}});
    }
    void add(Diagnostic diagnostic) {
        constexpr std::size_t most = 1000;  // a file of a million mistakes must not cost a gigabyte
        const bool is_error = diagnostic.severity == Severity::error;
        ++(is_error ? errors_ : warnings_);
        // An error is never lost behind warnings.
        if (all_.size() < most || (is_error && errors_ == 1)) all_.push_back(std::move(diagnostic));
    }

    bool failed() const { return errors_ > 0; }
    int errors() const { return errors_; }
    int warnings() const { return warnings_; }
    const std::vector<Diagnostic>& all() const { return all_; }

    bool lenient = false;

  private:
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
