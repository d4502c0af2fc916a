// PNG files, 8 bits per channel.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/huge_pages.h"

namespace forage::bug {

using Pixels = HugeVector<std::uint32_t>;

/// A picture with a border round it.
struct Image {
    int width = 0, height = 0;  ///< without the border
    int border = 0;             ///< pixels on every side, which repeat the nearest ones of the picture
    Pixels pixels;              ///< in rows from the top: red, green, blue, 255, from the low byte

    std::size_t stride() const { return static_cast<std::size_t>(width + 2 * border); }
    /// From the left; negative ones are of the border.
    std::uint32_t* row(int row) {
        return &pixels[static_cast<std::size_t>(row + border) * stride()] + border;
    }
};

/// Transparent pixels stand before black. Throws std::runtime_error with the reason when the file cannot be
/// read.
Image read_png(const std::string& path, int border);

/// What keeps a file from being a picture for read_png(), as far as its beginning and end tell; empty when
/// nothing does. Much text before the pixels is refused in every picture, though read_png() passes over it in
/// those of the usual kind.
std::string png_problem(const std::string& path);

/// Throws std::runtime_error with the reason when the file cannot be written.
void write_png(const std::string& path, int width, int height, std::span<const std::uint8_t> rgb);

/// The bytes of a PNG file, made quickly rather than small.
std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace forage::bug
