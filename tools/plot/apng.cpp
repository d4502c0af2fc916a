#include "tools/plot/apng.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include <zlib.h>

namespace forage::plot {
namespace {

constexpr std::size_t signature = 8;

std::string number(std::uint32_t value, int bytes) {
    std::string out;
    for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xFF);
    return out;
}

std::uint32_t number_at(std::string_view text, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(text.at(at + i));
    return out;
}

std::string chunk(std::string_view type, std::string_view data) {
    std::string body(type);
    body += data;
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return number(static_cast<std::uint32_t>(data.size()), 4) + body +
           number(static_cast<std::uint32_t>(crc), 4);
}

struct Png {
    std::string_view header;
    std::vector<std::string_view> pixels;
};

Png parse(std::string_view file) {
    Png out;
    for (std::size_t at = signature; at + 12 <= file.size();) {
        const std::size_t size = number_at(file, at);
        const std::string_view type = file.substr(at + 4, 4);
        if (at + 12 + size > file.size()) break;
        if (type == "IHDR") out.header = file.substr(at + 8, size);
        if (type == "IDAT") out.pixels.push_back(file.substr(at + 8, size));
        at += 12 + size;
    }
    if (out.header.size() != 13 || out.pixels.empty()) throw std::runtime_error("a frame is not a PNG file");
    return out;
}

}  // namespace

std::string animated_png(const std::vector<std::string>& frames, double seconds) {
    if (frames.empty()) throw std::runtime_error("an animation needs a frame");
    const auto milliseconds = static_cast<std::uint32_t>(std::clamp(std::lround(seconds * 1000), 1L, 65535L));
    const Png first = parse(frames.front());
    std::string out = frames.front().substr(0, signature) + chunk("IHDR", first.header) +
                      chunk("acTL", number(static_cast<std::uint32_t>(frames.size()), 4) + number(0, 4));
    std::uint32_t sequence = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Png frame = parse(frames[i]);
        if (frame.header != first.header)
            throw std::runtime_error("the frames of an animation differ in size");
        out += chunk("fcTL", number(sequence++, 4) + std::string(first.header.substr(0, 8)) +
                                 std::string(8, '\0') + number(milliseconds, 2) + number(1000, 2) +
                                 std::string(2, '\0'));  // at (0, 0); replaces the previous frame
        for (const auto data : frame.pixels)
            out += i == 0 ? chunk("IDAT", data) : chunk("fdAT", number(sequence++, 4) + std::string(data));
    }
    return out + chunk("IEND", "");
}

}  // namespace forage::plot
