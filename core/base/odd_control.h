// Control characters that no text of a file has.
#pragma once

#include <string>
#include <string_view>

#include "core/base/printable.h"

namespace forage {

/// Whether a text has a control character that is no white space, such as ESC or U+0085.
inline bool has_odd_control(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const bool is_white = text[0] == '\t' || text[0] == '\n' || text[0] == '\r';
        if (length > 0 && !is_white && is_control(character_number(text))) return true;
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return false;
}

}  // namespace forage
