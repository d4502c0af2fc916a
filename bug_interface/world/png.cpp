#include "bug_interface/world/png.h"

#include <stdexcept>

#include <png.h>

namespace forage::bug {

namespace {
constexpr png_uint_32 most_pixels = 16384;
}

Image read_png(const std::string& path) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&png, path.c_str()))
        throw std::runtime_error(path + ": " + png.message);
    png.format = PNG_FORMAT_RGB;
    Image image{static_cast<int>(png.width), static_cast<int>(png.height),
                std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
    const png_color black{0, 0, 0};  // behind transparent pixels
    if (!png_image_finish_read(&png, &black, image.rgb.data(), 0, nullptr))
        throw std::runtime_error(path + ": " + png.message);
    return image;
}

std::string png_problem(const std::string& path) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&png, path.c_str())) return png.message;
    const auto width = png.width, height = png.height;
    png_image_free(&png);
    if (width > most_pixels || height > most_pixels)
        return "it has more than " + std::to_string(most_pixels) + " pixels in a row or column";
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
