// Words of a shell's command line.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/printable.h"

namespace forage {

/// `text` as one word of a shell, in single quotes. A text with control characters becomes $'...' in ASCII,
/// which bash and zsh understand: a terminal would carry them out when the word is pasted.
inline std::string shell_word(std::string_view text) {
    const bool escapes = has_control(text);
    std::string out = escapes ? "$'" : "'";
    for (const char c : text) {
        char number[8];
        std::snprintf(number, sizeof number, "\\%03o", static_cast<unsigned char>(c));
        if (escapes && (c < ' ' || c > '~' || c == '\'' || c == '\\'))
            out += number;
        else
            out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return out + "'";
}

}  // namespace forage
