// A picture on a floor, stored for fast bilinear lookup.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bug_interface/sensing/marked_cells.h"
#include "bug_interface/world/description.h"
#include "bug_interface/world/png.h"

namespace forage::bug {

/// A picture and the light that falls on it. What is seen is min(1, gain * texel), bilinear between texel
/// centres.
///
/// Texels carry a flag, "this one and its right, lower and lower right neighbours are equal": most of a floor
/// is of one colour, and there a lookup reads one texel instead of interpolating four. The result is the
/// same.
class FloorTexture {
  public:
    /// `image` has a border of one pixel. `gain`: light on a white texel, per channel; may exceed 1.
    FloorTexture(Image image, const Colour& gain);
    /// One colour everywhere: a picture of 1 x 1.
    explicit FloorTexture(const Colour& colour);

    int width() const { return width_; }    ///< texels
    int height() const { return height_; }  ///< texels

    /// Where the texel is whose middle is up to one texel left of and above the point (u, v). u in [0, width]
    /// from the left edge, v in [0, height] from the top edge, in texels.
    int index(float u, float v) const {
        return static_cast<int>(v + 0.5f) * stride_ + static_cast<int>(u + 0.5f);
    }
    /// Whether all points of the rectangle, which must lie on the picture, look up texels that are flat: then
    /// all are of one colour.
    bool even(float u_first, float u_last, float v_first, float v_last) const {
        const auto column = [](float u) { return static_cast<std::size_t>(u + 0.5f); };
        return uneven_.none(column(u_first), column(u_last), column(v_first), column(v_last));
    }
    /// A row of the picture, from the top: red, green and blue from the low byte, and a flag.
    const std::uint32_t* row(int row) const {
        return &texels_[static_cast<std::size_t>((row + 1) * stride_ + 1)];
    }
    std::uint32_t texel(int index) const { return texels_[static_cast<std::size_t>(index)]; }
    static bool flat(std::uint32_t texel) { return texel >> 24; }
    /// Colour of a flat texel, channel by channel in 0..1.
    float red(std::uint32_t texel) const { return seen_[0][texel & 255u]; }
    float green(std::uint32_t texel) const { return seen_[1][texel >> 8 & 255u]; }
    float blue(std::uint32_t texel) const { return seen_[2][texel >> 16 & 255u]; }

    /// Adds the colour seen at (u, v) to rgb[0..2].
    void add(float u, float v, float* rgb) const {
        const std::uint32_t t = texel(index(u, v));
        if (flat(t))
            rgb[0] += red(t), rgb[1] += green(t), rgb[2] += blue(t);
        else
            add_blend(u, v, rgb);
    }

  private:
    void add_blend(float u, float v, float* rgb) const;

    int width_, height_;
    int stride_;          ///< width + 2: the border is repeated once on every side
    Pixels texels_;       ///< red, green, blue, flag; from the low byte
    MarkedCells uneven_;  ///< texels that are not flat
    Colour gain_;         ///< of a value in 0..255
    std::array<std::array<float, 256>, 3> seen_;
};

}  // namespace forage::bug
