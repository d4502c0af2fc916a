#include "bug_interface/world/png.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <png.h>

#include "bug_interface/world/any_png.h"
#include "bug_interface/world/plain_png.h"

namespace forage::bug {

namespace {

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
    Image image;
    image.border = border;
    if (!read_plain_png(path, image)) read_any_png(path, image);
    fill_border(image);
    return image;
}

std::string png_problem(const std::string& path) {
    if (!std::filesystem::is_regular_file(path))
        return "it is no file";  // reading a pipe would wait for ever
    if (std::string problem = any_png_problem(path); !problem.empty()) return problem;
    std::ifstream file(path, std::ios::binary);
    file.seekg(-8, std::ios::end);
    char last[4] = {};
    if (!file.read(last, sizeof last) || std::string_view(last, sizeof last) != "IEND")
        return "its end is missing";
    return {};
}

void write_png(const std::string& path, int width, int height, std::span<const std::uint8_t> rgb) {
    if (rgb.size() != std::size_t(3) * std::size_t(width) * std::size_t(height))
        throw std::runtime_error(path + ": the number of pixels is not width x height");
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width);
    png.height = static_cast<png_uint_32>(height);
    png.format = PNG_FORMAT_RGB;
    if (!png_image_write_to_file(&png, path.c_str(), 0, rgb.data(), 0, nullptr))
        throw std::runtime_error(path + ": " + png.message);
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
