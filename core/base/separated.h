// Texts in a row.
#pragma once

#include <string>
#include <string_view>

#include "core/base/separated.h"

namespace forage {

/// The texts of a container, with `separator` between them. separated() does the same, but each room that
/// uses it takes 0.2 s longer to compile.
template <class Texts>
std::string separated(const Texts& texts, std::string_view separator) {
    std::string out;
    bool first = true;
    for (const auto& text : texts) {
        if (!first) out += separator;
        out += std::string_view(text);
        first = false;
    }
    return out;
}

}  // namespace forage
