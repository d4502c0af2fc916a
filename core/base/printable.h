// Texts of foreign origin, for a terminal.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/utf8.h"

namespace forage {

/// Whether a character is one of the control characters of ASCII and Unicode.
inline bool is_control(unsigned number) { return number < ' ' || (number >= 0x7f && number < 0xa0); }
/// Whether a character begins another line or changes the order of what follows, so that a name looks like
/// another one: U+2028 to U+202E, U+2066 to U+2069.
inline bool reorders(unsigned number) {
    return (number >= 0x2028 && number <= 0x202e) || (number >= 0x2066 && number <= 0x2069);
}

/// Whether `f(sound, number)` holds for a character of a text; a byte that is not UTF-8 is not sound.
template <class F>
bool any_character(std::string_view text, F f) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (f(length > 0, character_number(text))) return true;
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return false;
}
/// Whether `text` has a control character, such as a line end or U+0085, or one that reorders it.
inline bool has_control(std::string_view text) {
    return any_character(text,
                         [](bool sound, unsigned c) { return sound && (is_control(c) || reorders(c)); });
}
/// Whether a text has a control character that is no white space and that no text of a file has, such as ESC.
inline bool has_odd_control(std::string_view text) {
    return any_character(text, [](bool sound, unsigned c) {
        return sound && is_control(c) && c != '\t' && c != '\n' && c != '\r';
    });
}

/// `text` with its control characters, except line ends and tabs, the characters that reorder it, and its
/// bytes that are not UTF-8 as escapes: "\x1b" for ESC. A terminal would carry them out.
inline std::string printable(std::string_view text) {
    std::string out;
    const auto escape = [&](const char* form, unsigned number) {
        char buffer[8];
        std::snprintf(buffer, sizeof buffer, form, number);
        out += buffer;
    };
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto byte = static_cast<unsigned char>(text[0]);
        const unsigned character = character_number(text);
        if (length == 0 || (byte < ' ' && byte != '\n' && byte != '\t'))
            escape("\\x%02x", byte);
        else if (byte >= ' ' && (is_control(character) || reorders(character)))
            escape("\\u%04x", character);
        else
            out += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
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
