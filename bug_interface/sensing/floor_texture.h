// The picture of a floor, stored for fast bilinear interpolation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bug_interface/sensing/bit_grid.h"
#include "bug_interface/world/description.h"
#include "bug_interface/world/png.h"

namespace forage::bug {

/// A picture and the light on it. The visible colour is min(1, gain * texel), interpolated bilinearly between
/// the centres of the texels.
///
/// A texel is flat when it equals its right, lower and lower right neighbours. There the interpolation only
/// needs one texel instead of four, with the same result. Most of a floor is flat.
class FloorTexture {
  public:
    /// `image` must have a border of one pixel. `gain` is the colour of a white texel; it may exceed 1.
    FloorTexture(Image image, const Colour& gain);
    /// A floor of one colour: a picture of 1 x 1 texels.
    explicit FloorTexture(const Colour& colour);

    int width() const { return width_; }    ///< texels
    int height() const { return height_; }  ///< texels

    /// The index of the upper left one of the four texels whose centres surround the point (u, v). `u` in [0,
    /// width] from the left edge, `v` in [0, height] from the top edge, in texels.
    int index(float u, float v) const {
        return static_cast<int>(v + 0.5f) * stride_ + static_cast<int>(u + 0.5f);
    }
    /// Whether all points of a rectangle on the picture have the same colour: all their texels are flat.
    bool uniform(float u_first, float u_last, float v_first, float v_last) const {
        const auto column = [](float u) { return static_cast<std::size_t>(u + 0.5f); };
        return not_flat_.none_in(column(u_first), column(u_last), column(v_first), column(v_last));
    }
    /// Row `row` of the picture, from the top. A texel has red, green, blue (from the low byte) and a flag.
    const std::uint32_t* row(int row) const {
        return &texels_[static_cast<std::size_t>((row + 1) * stride_ + 1)];
    }
    std::uint32_t texel(int index) const { return texels_[static_cast<std::size_t>(index)]; }
    static bool flat(std::uint32_t texel) { return texel >> 24; }
    /// The visible channels of a flat texel, 0..1.
    float red(std::uint32_t texel) const { return visible_[0][texel & 255u]; }
    float green(std::uint32_t texel) const { return visible_[1][texel >> 8 & 255u]; }
    float blue(std::uint32_t texel) const { return visible_[2][texel >> 16 & 255u]; }

    /// Adds the visible colour at (u, v) to rgb[0..2].
    void add(float u, float v, float* rgb) const {
        const std::uint32_t t = texel(index(u, v));
        if (flat(t))
            rgb[0] += red(t), rgb[1] += green(t), rgb[2] += blue(t);
        else
            add_interpolated(u, v, rgb);
    }

  private:
    void add_interpolated(float u, float v, float* rgb) const;

    int width_, height_;
    int stride_;     ///< width + 2: the picture has a border of one texel
    Pixels texels_;  ///< red, green, blue, flag; from the low byte
    BitGrid not_flat_;
    Colour gain_;                                    ///< factor from a value in 0..255 to the visible channel
    std::array<std::array<float, 256>, 3> visible_;  ///< [channel][value], 0..1
};

}  // namespace forage::bug
