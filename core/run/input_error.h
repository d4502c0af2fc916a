// Mistakes of users, as an exception.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/diagnostic.h"

namespace forage {

/// Mistakes in files, systems, plugins or expressions. what() lists all of them, as `forage check` prints
/// them.
class InputError : public std::runtime_error {
  public:
    explicit InputError(Diagnostics found)
        : std::runtime_error(format(found)), diagnostics_(std::make_shared<Diagnostics>(std::move(found))) {}
    /// One mistake without a place in a file.
    explicit InputError(const std::string& message, const std::string& hint = {})
        : InputError(only(message, hint)) {}

    /// The mistakes, each with its place and its hint, and the warnings about the same input.
    const Diagnostics& diagnostics() const { return *diagnostics_; }

  private:
    static Diagnostics only(const std::string& message, const std::string& hint) {
        Diagnostics out;
        out.error({}, message, hint);
        return out;
    }
    std::shared_ptr<const Diagnostics> diagnostics_;  ///< shared, as copies of an exception must not throw
};

/// A file would be replaced, and that was not asked for.
class FileExists : public InputError {
    using InputError::InputError;
};

/// Adds `found` to `to`, unless that is null.
inline void append(Diagnostics* to, const Diagnostics& found) {
    if (!to) return;
    for (const auto& d : found.all()) to->add(d);
}

/// Throws InputError when there is an error among the diagnostics.
inline void throw_errors(Diagnostics diagnostics) {
    if (diagnostics.failed()) throw InputError(std::move(diagnostics));
}

/// `result`, unless there is an error among the diagnostics with which it was made: then throws InputError.
template <class T>
T checked(const Diagnostics& diagnostics, T result) {
    throw_errors(diagnostics);
    return result;
}

}  // namespace forage
