// PNG files, 8 bits per channel.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace forage::bug {

/// Pixels in rows from the top, three bytes (red, green, blue) each.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    const std::uint8_t* pixel(int column, int row) const {
        return &rgb[3 * (std::size_t(row) * std::size_t(width) + std::size_t(column))];
    }
    std::uint8_t* pixel(int column, int row) {
        return &rgb[3 * (std::size_t(row) * std::size_t(width) + std::size_t(column))];
    }
};

/// Throws std::runtime_error with the reason when the file cannot be read.
Image read_png(const std::string& path);

/// What keeps a file from being a picture for read_png(), as far as its beginning and end tell; empty when
/// nothing does.
std::string png_problem(const std::string& path);

/// Throws std::runtime_error with the reason when the file cannot be written.
void write_png(const std::string& path, int width, int height, std::span<const std::uint8_t> rgb);

/// The bytes of a PNG file, made quickly rather than small.
std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace forage::bug
