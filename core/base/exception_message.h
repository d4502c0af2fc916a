// The message of any exception.
#pragma once

#include <exception>
#include <string>

#include "core/base/printable.h"

namespace forage {

/// The message of the exception that is being handled, whatever its type is, for a terminal. Call it in a
/// `catch (...)` block.
inline std::string current_exception_message() {
    try {
        throw;
    } catch (const std::exception& e) {
        return printable(e.what());
    } catch (...) {
        return "something that is not a std::exception was thrown";
    }
}

}  // namespace forage
