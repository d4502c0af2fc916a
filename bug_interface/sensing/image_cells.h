// The conversion of a camera's picture into the cells of three groups.
#pragma once

#include <cstdint>
#include <span>

namespace forage::bug {

enum class ColourSpace {
    rgb,  ///< red, green, blue
    hsv,  ///< hue (red 0, green 1/3, blue 2/3), saturation, value; all 0 for black
    grey  ///< the grey value in all three groups
};

/// Peculiarities of the original.
struct ImageQuirks {
    /// Whether pictures are always resampled. The original crops a picture when the groups have its width or
    /// its height.
    bool always_resample = false;
    /// Whether the 8-bit value 1 means 1.0, as in the original, which gives white specks on black floors.
    bool salt = false;
    /// The weight of green in grey: 0.7512 as in the original, by mistake for 0.7152.
    double grey_green = 0.7512;
};

/// Fills three groups of w x h cells, row 0 at the top, from an 8-bit picture of `width` x `height` pixels
/// (rows from the top, three bytes per pixel). Values are in 0..1; grey values are at most 1.036.
///
/// When both w and h differ from the size of the picture, it is resampled with the cubic filter of Mitchell
/// and Netravali (B = C = 1/3). When only one of them differs, the left w columns and the bottom h rows are
/// used. Throws std::invalid_argument when a size is not positive, when a cropped size exceeds the picture,
/// and when a span is too short.
void image_cells(std::span<const std::uint8_t> rgb, int width, int height, ColourSpace space, int w, int h,
                 std::span<double> first, std::span<double> second, std::span<double> third,
                 const ImageQuirks& quirks = {});

}  // namespace forage::bug
