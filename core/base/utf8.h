// UTF-8 characters.
#pragma once

#include <cstddef>
#include <string_view>

namespace forage {

/// The length of the UTF-8 character at the beginning of `text`, in bytes; 0 when there is none (RFC 3629).
inline std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&](std::size_t n) {
        for (std::size_t i = 1; i < n; ++i)
            if ((byte(i) & 0xc0u) != 0x80u) return false;
        return true;
    };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first < 0xe0) return continues(2) ? 2 : 0;
    if (first >= 0xe0 && first < 0xf0)
        return continues(3) && !(first == 0xe0 && second < 0xa0) && !(first == 0xed && second >= 0xa0) ? 3
                                                                                                       : 0;
    if (first >= 0xf0 && first < 0xf5)
        return continues(4) && !(first == 0xf0 && second < 0x90) && !(first == 0xf4 && second >= 0x90) ? 4
                                                                                                       : 0;
    return 0;
}

/// The Unicode number of the first character of a text; the byte itself when it is not UTF-8.
inline char32_t character_number(std::string_view text) {
    const std::size_t length = utf8_length(text);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    char32_t number = length < 2 ? byte(0) : byte(0) & (0xffu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) number = number << 6 | (byte(i) & 0x3fu);
    return number;
}

}  // namespace forage
