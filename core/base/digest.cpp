#include "core/base/digest.h"

#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <sha2.h>

namespace forage {

std::string digest(std::string_view text) { return fmt::format("{:016x}", fnv1a(text)); }

std::string sha256(std::string_view text) {
    std::array<char, SHA256_DIGEST_STRING_LENGTH> out{};
    SHA256Data(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), out.data());
    return out.data();
}

std::string file_digest(const std::string& path) {
    std::array<char, SHA256_DIGEST_STRING_LENGTH> out{};
    std::error_code none;  // the content of a pipe cannot be read again
    const bool read = std::filesystem::is_regular_file(path, none) && SHA256File(path.c_str(), out.data());
    return read ? out.data() : sha256("");
}

}  // namespace forage
