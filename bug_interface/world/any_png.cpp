#include "bug_interface/world/any_png.h"

#include <fstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "bug_interface/world/png_limits.h"

namespace forage::bug {
namespace {

/// Whether more than that stands before the first pixels. A chunk is its length, its name, its content and a
/// checksum. What is no such file at all, or ends too early, is left to libpng.
bool begins_late(std::istream& file) {
    constexpr std::uint64_t signature_size = 8, around_content = 12;
    char head[8];  // the signature, and then the length and the name of each chunk
    const auto read = [&](std::uint64_t at) {
        return bool(file.seekg(static_cast<std::streamoff>(at)).read(head, sizeof head));
    };
    if (!read(0) || std::string_view(head, sizeof head) != "\x89PNG\r\n\x1a\n") return false;
    for (std::uint64_t at = signature_size; read(at);) {
        if (std::string_view(head + 4, 4) == "IDAT") return false;
        std::uint64_t length = 0;
        for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(head[i]);
        at += length + around_content;
        if (at > most_before_pixels)
            return static_cast<std::uint64_t>(file.seekg(0, std::ios::end).tellg()) > most_before_pixels;
    }
    return false;
}

/// What libpng's general reader knows of a file.
struct AnyReader {
    png_image png{};
    AnyReader() { png.version = PNG_IMAGE_VERSION; }
    ~AnyReader() { png_image_free(&png); }
    AnyReader(const AnyReader&) = delete;
    AnyReader& operator=(const AnyReader&) = delete;
};

/// Reads up to the pixels; returns what is wrong.
std::string begin_reading(AnyReader& reader, const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (begins_late(file))
        return fmt::format(
            "more than {} KiB of texts, profiles and the like stand before its pixels; save it without them",
            most_before_pixels >> 10);
    if (!png_image_begin_read_from_file(&reader.png, path.c_str())) return reader.png.message;
    const std::uint64_t pixels = std::uint64_t{reader.png.width} * reader.png.height;
    if (pixels > most_pixels) return fmt::format("it has {} pixels; the most are {}", pixels, most_pixels);
    return {};
}

}  // namespace

void read_any_png(const std::string& path, Image& image) {
    AnyReader reader;
    if (const std::string problem = begin_reading(reader, path); !problem.empty())
        throw std::runtime_error(path + ": " + problem);
    png_image& png = reader.png;
    image.width = static_cast<int>(png.width);
    image.height = static_cast<int>(png.height);
    image.pixels.resize(image.stride() * static_cast<std::size_t>(image.height + 2 * image.border));
    const bool opaque = !(png.format & PNG_FORMAT_FLAG_ALPHA);
    png.format = opaque ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    const png_color black{0, 0, 0};
    std::vector<std::uint8_t> rgb(opaque ? 0 : PNG_IMAGE_SIZE(png));
    void* to = opaque ? static_cast<void*>(image.row(0)) : rgb.data();
    const auto stride = static_cast<png_int_32>(opaque ? 4 * image.stride() : 0);
    if (!png_image_finish_read(&png, &black, to, stride, nullptr))
        throw std::runtime_error(path + ": " + png.message);
    const std::uint8_t* p = rgb.data();
    for (int r = 0; r < image.height && !opaque; ++r)
        for (int c = 0; c < image.width; ++c, p += 3)
            image.row(r)[c] = 0xff000000u | std::uint32_t{p[2]} << 16 | std::uint32_t{p[1]} << 8 | p[0];
}

std::string any_png_problem(const std::string& path) {
    AnyReader reader;
    return begin_reading(reader, path);
}

}  // namespace forage::bug
