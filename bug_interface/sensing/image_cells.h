// From a camera's picture to the cells of three groups.
#pragma once

#include <cstdint>
#include <span>

namespace forage::bug {

enum class ColourSpace {
    rgb,  ///< red, green, blue
    hsv,  ///< hue (red 0, green 1/3, blue 2/3), saturation, value; all 0 for black
    grey  ///< the same grey three times
};

/// Peculiarities of the original that can be chosen otherwise.
struct ImageQuirks {
    bool always_resample =
        false;          ///< the original crops when the groups have the picture's width or its height
    bool salt = false;  ///< the original takes the 8-bit value 1 for 1.0: white specks on black floors
    double grey_green = 0.7512;  ///< weight of green in grey; 0.7152 was meant
};

/// Fills three groups of w x h cells, row 0 on top, from an 8-bit picture of `width` x `height` pixels (rows
/// from the top, three bytes each). Values are in 0..1 (grey up to 1.036).
///
/// When w and h both differ from the picture's, it is resampled (Mitchell and Netravali's cubic, B = C =
/// 1/3); when only one does, its left w columns and its bottom h rows are used. Throws std::invalid_argument
/// when a size is not positive, a cropped one exceeds the picture, or a span is too short.
void image_cells(std::span<const std::uint8_t> rgb, int width, int height, ColourSpace space, int w, int h,
                 std::span<double> first, std::span<double> second, std::span<double> third,
                 const ImageQuirks& quirks = {});

}  // namespace forage::bug
