// The conversion of a camera's picture into the cells of three groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// How one side of a picture is resampled: pixel i of the result is the sum of weights[first_weight + k] x
/// source pixel (first + k), for the window i.
struct ResampledSide {
    struct Window {
        std::size_t first, count, first_weight;
    };
    std::vector<Window> windows;
    std::vector<double> weights;

    ResampledSide() = default;
    ResampledSide(std::size_t from, std::size_t to);
};

/// Fills three groups of w x h cells, row 0 at the top, from 8-bit pictures (rows from the top, three bytes
/// per pixel). Values are in 0..1; grey values are at most 1.036.
///
/// When both w and h differ from the size of the picture, it is resampled with the cubic filter of Mitchell
/// and Netravali (B = C = 1/3). When only one of them differs, the left w columns and the bottom h rows are
/// used.
class ImageCells {
  public:
    /// Pictures have `width` x `height` pixels. Throws std::invalid_argument when a size is not positive, and
    /// when a cropped size exceeds the picture.
    ImageCells(int width, int height, int w, int h, const ImageQuirks& quirks = {});

    /// Throws std::invalid_argument when a span is too short. Does not allocate memory.
    void fill(std::span<const std::uint8_t> rgb, ColourSpace space, std::span<double> first,
              std::span<double> second, std::span<double> third);

  private:
    void resample(const std::uint8_t* rgb);

    std::size_t width_, height_, w_, h_;
    ImageQuirks quirks_;
    bool resampled_;
    ResampledSide columns_, rows_;
    /// Pixels while a picture is resampled, four numbers each, 0..255: four rows of the picture, side by
    /// side, then the picture with its width resampled, and the result.
    std::vector<double> source_, narrow_, result_;
};

}  // namespace forage::bug
