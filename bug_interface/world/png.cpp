#include "bug_interface/world/png.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <png.h>

namespace forage::bug {
namespace {

constexpr std::uint64_t max_pixels = 4096 * 4096;  // a floor takes 4 bytes for each
// Texts and profiles may be compressed a thousandfold, and libpng expands all of them.
constexpr std::uint64_t max_before_pixels = 64 << 10;

/// Whether more than `max_before_pixels` bytes precede the first pixels. A chunk is its length, its name,
/// its content and a checksum. libpng refuses files that are not PNG files or end too early.
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
        if (at > max_before_pixels)
            return static_cast<std::uint64_t>(file.seekg(0, std::ios::end).tellg()) > max_before_pixels;
    }
    return false;
}

/// A PNG file, read up to its pixels.
struct PngFile {
    png_image png{};
    std::string problem;  ///< the first mistake in the file; empty when none was found

    explicit PngFile(const std::string& path) {
        png.version = PNG_IMAGE_VERSION;
        std::ifstream file(path, std::ios::binary);
        if (begins_late(file)) {
            problem = fmt::format(
                "more than {} KiB of texts, profiles and the like precede its pixels; save it without them",
                max_before_pixels >> 10);
        } else if (!png_image_begin_read_from_file(&png, path.c_str())) {
            problem = png.message;
        } else if (const auto pixels = std::uint64_t{png.width} * png.height; pixels > max_pixels) {
            problem = fmt::format("it has {} pixels; the most are {}", pixels, max_pixels);
        }
    }
    ~PngFile() { png_image_free(&png); }
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;
};

/// Reads the pixels of `png` into the rows of `image`. Returns whether that was possible.
bool read_pixels(png_image& png, Image& image) {
    if (!(png.format & PNG_FORMAT_FLAG_ALPHA)) {
        png.format = PNG_FORMAT_RGBA;
        return png_image_finish_read(&png, nullptr, image.row(0), static_cast<png_int_32>(4 * image.stride()),
                                     nullptr) != 0;
    }
    png.format = PNG_FORMAT_RGB;
    const png_color black{0, 0, 0};
    std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(png));
    if (!png_image_finish_read(&png, &black, rgb.data(), 0, nullptr)) return false;
    const std::uint8_t* p = rgb.data();
    for (int r = 0; r < image.height; ++r)
        for (int c = 0; c < image.width; ++c, p += 3)
            image.row(r)[c] = 0xff000000u | std::uint32_t{p[2]} << 16 | std::uint32_t{p[1]} << 8 | p[0];
    return true;
}

void fill_border(Image& image) {
    for (int r = 0; r < image.height; ++r) {
        std::uint32_t* row = image.row(r);
        std::fill_n(row - image.border, image.border, row[0]);
        std::fill_n(row + image.width, image.border, row[image.width - 1]);
    }
    for (int r = 1; r <= image.border; ++r)
        for (const auto& [from, to] : {std::pair(0, -r), {image.height - 1, image.height - 1 + r}})
            std::copy_n(image.row(from) - image.border, image.stride(), image.row(to) - image.border);
}

}  // namespace

Image read_png(const std::string& path, int border) {
    PngFile file(path);
    if (!file.problem.empty()) throw std::runtime_error(path + ": " + file.problem);
    Image image;
    image.width = static_cast<int>(file.png.width);
    image.height = static_cast<int>(file.png.height);
    image.border = border;
    image.pixels.resize(image.stride() * static_cast<std::size_t>(image.height + 2 * border));
    if (!read_pixels(file.png, image)) throw std::runtime_error(path + ": " + file.png.message);
    fill_border(image);
    return image;
}

std::string png_problem(const std::string& path) {
    if (!std::filesystem::is_regular_file(path))
        return "it is not a file";  // reading a pipe would wait for its writer
    if (PngFile png(path); !png.problem.empty()) return png.problem;
    std::ifstream file(path, std::ios::binary);
    file.seekg(-8, std::ios::end);
    char last[4] = {};
    if (!file.read(last, sizeof last) || std::string_view(last, sizeof last) != "IEND")
        return "its end is missing";
    return {};
}

std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb) {
    if (rgb.size() != std::size_t(3) * std::size_t(width) * std::size_t(height))
        throw std::runtime_error("the number of pixels is not width x height");
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width);
    png.height = static_cast<png_uint_32>(height);
    png.format = PNG_FORMAT_RGB;
    png.flags = PNG_IMAGE_FLAG_FAST;
    std::string out(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
    png_alloc_size_t size = out.size();
    if (!png_image_write_to_memory(&png, out.data(), &size, 0, rgb.data(), 0, nullptr))
        throw std::runtime_error(png.message);
    out.resize(size);
    return out;
}

}  // namespace forage::bug
