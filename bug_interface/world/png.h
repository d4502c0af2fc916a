// PNG files, 8 bits per channel, read and written by libpng's simplified interface.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/base/huge_pages.h"

namespace forage::bug {

using Pixels = HugeVector<std::uint32_t>;

/// A picture with a border around it.
struct Image {
    int width = 0, height = 0;  ///< without the border
    int border = 0;             ///< pixels on every side; they repeat the nearest pixels of the picture
    Pixels pixels;              ///< rows from the top; a pixel is red, green, blue and 255, from the low byte

    std::size_t stride() const { return static_cast<std::size_t>(width + 2 * border); }
    /// The first pixel of a row, from the left; negative rows belong to the border.
    std::uint32_t* row(int row) {
        return &pixels[static_cast<std::size_t>(row + border) * stride()] + border;
    }
};

/// Reads a picture of any kind, with a border of `border` pixels. Transparent pixels are drawn on black.
/// Throws std::runtime_error with the reason when the file cannot be read, is larger than 4096 x 4096 pixels,
/// or has more than 64 KiB of texts and profiles before its pixels.
Image read_png(const std::string& path, int border);

/// Returns the reason why read_png() cannot read a file, as far as the file's beginning and end show it;
/// empty when they show none.
std::string png_problem(const std::string& path);

/// The bytes of a PNG file, compressed for speed rather than size. `rgb` holds three bytes per pixel in rows
/// from the top.
std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace forage::bug
