// Digests: of states, to compare them; of files, to bind a run to what it has read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace forage {

/// The 64-bit FNV-1a digest of a text, which shows whether the text has changed.
inline std::uint64_t fnv1a(std::string_view text) {  // here, as the generator is part of every plugin
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}
/// The same in hexadecimal digits.
std::string digest(std::string_view text);
/// The SHA-256 digest of a text in hexadecimal digits, which no other text has.
std::string sha256(std::string_view text);
/// The SHA-256 digest of a file's content; that of an empty text when there is no such file.
std::string file_digest(const std::string& path);

}  // namespace forage
