// The error of a run that cannot continue.
#pragma once

#include <stdexcept>

namespace forage::engine {

/// A type's update or a module's start failed; the message names the type, its place in the system and the
/// cycle.
class RunError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace forage::engine
