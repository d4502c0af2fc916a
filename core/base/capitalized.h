#pragma once

#include <cctype>
#include <string>

namespace forage {

/// The text with a capital letter at its start.
inline std::string capitalized(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

}  // namespace forage
