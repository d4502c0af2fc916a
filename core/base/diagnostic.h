// Diagnostics: all mistakes in a file, reported in one run and written for the author of the file. Plugins
// use the classes, which are complete in this header; the functions need the library.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace forage {

/// A file that was read for a user.
struct SourceFile {
    std::string path;       ///< as the user wrote it
    std::string text;       ///< may end early, as it is used for excerpts only
    std::string used = {};  ///< where another file uses it: "file:line"; empty for a file that stands alone
};

/// A place in a file. `line` and `column` (in bytes) count from 1; 0 means the file as a whole. A location
/// without a file is on the command line.
struct Location {
    std::shared_ptr<const SourceFile> file;
    int line = 0;
    int column = 0;

    /// Always true: models with the same content are equal, whatever their locations are.
    friend bool operator==(const Location&, const Location&) { return true; }
};

enum class Severity { error, warning };

/// The parameter or port about which the check() of a type reports a mistake. Types know names but not places
/// in a file; validation finds the places.
struct Subject {
    Subject(std::string parameter_name, std::string port_name)
        : parameter(std::move(parameter_name)), port(std::move(port_name)) {}
    std::string parameter;  ///< a parameter of the type; empty for none
    std::string port;       ///< a cross reference of a module type; empty for none
};
inline Subject at_parameter(std::string name) { return {std::move(name), {}}; }
inline Subject at_port(std::string name) { return {{}, std::move(name)}; }

/// One mistake in a file or on a command line.
struct Diagnostic {
    Severity severity = Severity::error;
    Location where;
    std::string message;
    std::string hint;             ///< how to correct it; may be empty
    std::string parameter, port;  ///< as in Subject, until validation has found the place
};

/// An error in a file that the caller names later. `line` and `column` count as in Location.
inline Diagnostic error_at(int line, int column, std::string message, std::string hint = {}) {
    return {Severity::error, {nullptr, line, column}, std::move(message), std::move(hint), {}, {}};
}

/// Collects diagnostics. It keeps the first thousand and counts the others.
class Diagnostics {
  public:
    void error(Location where, std::string message, std::string hint = {}) {
        add({Severity::error, std::move(where), std::move(message), std::move(hint), {}, {}});
    }
    void warning(Location where, std::string message, std::string hint = {}) {
        add({Severity::warning, std::move(where), std::move(message), std::move(hint), {}, {}});
    }
    /// Adds an error that the check() of a type has found.
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
    /// Reports something unknown that the original ignores: an error, or a warning if `lenient` is set.
    void unknown(Location where, std::string message, std::string hint = {}) {
        add({lenient ? Severity::warning : Severity::error,
             std::move(where),
             std::move(message),
             std::move(hint),
             {},
             {}});
    }
    void add(Diagnostic diagnostic) {
        constexpr std::size_t most = 1000;  // a file with a million mistakes must not take a gigabyte
        const bool is_error = diagnostic.severity == Severity::error;
        if (is_of_another_use(diagnostic)) return;
        ++(is_error ? errors_ : warnings_);
        // The first error is kept even after many warnings.
        if (all_.size() < most || (is_error && errors_ == 1)) all_.push_back(std::move(diagnostic));
    }

    bool failed() const { return errors_ > 0; }
    int errors() const { return errors_; }
    int warnings() const { return warnings_; }
    const std::vector<Diagnostic>& all() const { return all_; }

    bool lenient = false;

  private:
    /// Whether this mistake in a file was found before, where the file is used for another time.
    bool is_of_another_use(const Diagnostic& d) const {
        if (!d.where.file || d.where.file->used.empty()) return false;
        for (const Diagnostic& known : all_)
            if (known.where.file && known.where.file->path == d.where.file->path &&
                known.where.line == d.where.line && known.where.column == d.where.column &&
                known.message == d.message)
                return true;
        return false;
    }

    std::vector<Diagnostic> all_;
    int errors_ = 0, warnings_ = 0;
};

/// The location of the byte `offset` of a file.
Location location_of(std::shared_ptr<const SourceFile> file, std::size_t offset);

/// A diagnostic as text: `file:line:column: error: message`, then the line with a caret under the column,
/// then `hint: ...`.
std::string format(const Diagnostic& diagnostic);
/// All diagnostics as text, in order of their places; at most the first fifty.
std::string format(const Diagnostics& diagnostics);

/// The candidate that is most similar to `name` (edit distance, case ignored), or one that begins with it.
/// Empty when there is none.
std::string_view nearest(std::string_view name, std::span<const std::string> candidates);
/// A hint: "did you mean 'x'?", or the list of candidates when none is similar. Empty without candidates.
std::string suggest(std::string_view name, std::span<const std::string> candidates);

}  // namespace forage
