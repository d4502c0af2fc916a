// Control characters that no text of a file has.
#pragma once

#include <string>
#include <string_view>

#include "core/base/printable.h"

namespace forage {

/// Whether a text has a control character that is no white space, such as ESC or U+0085.
inline bool has_odd_control(std::string_view text) {
    std::string rest(text);
    std::erase_if(rest, [](char c) { return c == '\t' || c == '\n' || c == '\r'; });
    return has_control(rest);
}

}  // namespace forage
