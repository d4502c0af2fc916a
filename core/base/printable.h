// Texts of foreign origin, for a terminal.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/utf8.h"

namespace forage {

/// Whether `text` has a control character, such as a line end or U+0085.
inline bool has_control(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
        if (byte < ' ' || byte == 0x7f || (byte == 0xc2 && next >= 0x80 && next < 0xa0)) return true;
    }
    return false;
}

/// `text` with its control characters, except line ends and tabs, and its bytes that are not UTF-8 as
/// escapes:
/// "\x1b" for ESC. A terminal would carry them out.
inline std::string printable(std::string_view text) {
    std::string out;
    const auto escape = [&](const char* form, unsigned number) {
        char buffer[8];
        std::snprintf(buffer, sizeof buffer, form, number);
        out += buffer;
    };
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        const auto byte = static_cast<unsigned char>(text[i]);
        const unsigned next = length == 2 ? static_cast<unsigned char>(text[i + 1]) : 0u;
        if (length == 0 || (byte < ' ' && byte != '\n' && byte != '\t'))
            escape("\\x%02x", byte);
        else if (byte == 0x7f || (byte == 0xc2 && next < 0xa0))  // U+0080 to U+009F are control characters
            escape("\\u%04x", length == 2 ? next : byte);
        else
            out += text.substr(i, length);
        i += std::max<std::size_t>(length, 1);
    }
    return out;
}

/// The same as one line: line ends and tabs become blanks.
inline std::string printable_line(std::string_view text) {
    std::string out = printable(text);
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    return out;
}

}  // namespace forage
