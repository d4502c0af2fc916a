// Errors for types that break their declarations.
#pragma once

#include <stdexcept>
#include <string>

namespace forage {

/// A type uses a state, feedback or port that it does not declare, or computes with columns of different
/// sizes: a mistake of the type's author. The class is visible outside a plugin.
class __attribute__((visibility("default"))) TypeError : public std::logic_error {
    using std::logic_error::logic_error;
};

namespace detail {

/// Throws TypeError. It is a function of its own to keep the fast path short. `what` is "state", "feedback",
/// "input" or "output".
[[noreturn, gnu::cold, gnu::noinline]] inline void not_declared(const char* what, long long index,
                                                                std::size_t declared) {
    throw TypeError("it uses " + std::string(what) + " " + std::to_string(index) + ", but declares " +
                    std::to_string(declared) + (declared ? ", counted from 0" : ""));
}
[[noreturn, gnu::cold, gnu::noinline]] inline void not_as_many(std::size_t used, std::size_t declared) {
    throw TypeError("it uses " + std::to_string(used) + " states, but declares " + std::to_string(declared));
}
[[noreturn, gnu::cold, gnu::noinline]] inline void not_kept(int state, int ago, long long history) {
    throw TypeError("it reads state " + std::to_string(state) + " of " + std::to_string(ago) +
                    " cycles ago, but declares a history of " + std::to_string(history));
}

}  // namespace detail
}  // namespace forage
