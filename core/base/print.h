// The text that commands print. Control characters of names and messages are escaped, as a terminal would
// carry them out.
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "core/base/printable.h"

namespace forage {

/// Prints on the standard output, or to a stream, as fmt::print() does.
template <class... T>
void print(std::FILE* to, fmt::format_string<T...> form, T&&... values) {
    fmt::print(to, "{}", printable(fmt::format(form, std::forward<T>(values)...)));
}
template <class... T>
void print(fmt::format_string<T...> form, T&&... values) {
    forage::print(stdout, form, std::forward<T>(values)...);
}

}  // namespace forage
