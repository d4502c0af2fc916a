// Plugins include this header before everything else. It makes Eigen report an error when columns of
// different sizes are combined, instead of writing past their ends. This costs one comparison per expression
// and group. Access to single cells is checked in debug builds only ('forage build-plugin --debug').
#pragma once

#include <string_view>

#include "core/types/type_error.h"

namespace forage::detail {

/// Whether a condition that Eigen checks compares the sizes of whole arrays.
constexpr bool compares_sizes(std::string_view condition) {
    return condition.find("==") != std::string_view::npos;
}
[[noreturn, gnu::cold, gnu::noinline]] inline void sizes_differ(const char* condition) {
    const std::string_view text = condition;
    throw TypeError((text.find("index") == text.npos
                         ? "it computes with columns of different sizes (Eigen: "
                         : "it uses a cell that its column does not have (Eigen: ") +
                    std::string(text) + ")");
}

}  // namespace forage::detail

#ifdef NDEBUG
#define FORAGE_CHECKED(text) ::forage::detail::compares_sizes(text)
#else
#define FORAGE_CHECKED(text) true
#endif
#define eigen_assert(condition)                                           \
    do {                                                                  \
        if constexpr (FORAGE_CHECKED(#condition))                         \
            if (!(condition)) ::forage::detail::sizes_differ(#condition); \
    } while (false)
