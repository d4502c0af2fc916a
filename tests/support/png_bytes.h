// PNG files made chunk by chunk, also unusual ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace forage::test {

/// The four bytes of a number, with the highest first.
inline std::string big_endian(std::uint32_t v) {
    std::string out;
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(v >> shift & 0xff);
    return out;
}

/// CRC-32 as in the PNG specification, annex D.
inline std::uint32_t png_checksum(std::string_view bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const unsigned char c : bytes) {
        crc ^= c;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

inline std::string png_chunk(const std::string& name, const std::string& content) {
    const std::string all = name + content;
    return big_endian(static_cast<std::uint32_t>(content.size())) + all + big_endian(png_checksum(all));
}

/// `bytes` as a zlib stream that is not compressed; at most 65535 of them.
inline std::string zlib_stored(const std::string& bytes) {
    std::uint32_t a = 1, b = 0;  // Adler-32
    for (const unsigned char c : bytes) a = (a + c) % 65521, b = (b + a) % 65521;
    const auto n = static_cast<std::uint32_t>(bytes.size());
    const auto low_first = [](std::uint32_t v) {
        return std::string{static_cast<char>(v & 0xff), static_cast<char>(v >> 8 & 0xff)};
    };
    return "\x78\x01\x01" + low_first(n) + low_first(~n) + bytes + big_endian(b << 16 | a);
}

enum class PngColour { grey = 0, rgb = 2, palette = 3, rgb_alpha = 6 };

/// A picture of 8 bits per channel with `chunks` before its pixels; `rows` has a filter's number before each.
inline std::string png_file(std::uint32_t width, std::uint32_t height, PngColour colour,
                            const std::string& chunks, const std::string& rows) {
    const std::string kind{8, static_cast<char>(colour), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", big_endian(width) + big_endian(height) + kind) + chunks +
           png_chunk("IDAT", zlib_stored(rows)) + png_chunk("IEND", "");
}

}  // namespace forage::test
