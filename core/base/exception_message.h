// What somebody else's code says when it fails.
#pragma once

#include <exception>
#include <string>

namespace forage {

/// What the exception that is being handled says, whatever was thrown. To be called in a `catch (...)`.
inline std::string current_exception_message() {
    try {
        throw;
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "something that is not a std::exception was thrown";
    }
}

}  // namespace forage
