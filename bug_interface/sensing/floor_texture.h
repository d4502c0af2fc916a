// A picture on a floor, stored for fast bilinear lookup.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

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
    /// `gain`: light on a white texel, per channel; may exceed 1.
    FloorTexture(const Image& image, const Colour& gain);
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
    /// all are of one colour. Mostly a small table of blocks of texels knows.
    bool even(float u_first, float u_last, float v_first, float v_last) const {
        const auto column = [](float u) { return static_cast<std::size_t>(u + 0.5f); };
        const std::size_t left = column(u_first), right = column(u_last), top = column(v_first),
                          bottom = column(v_last);
        return uneven_blocks_.none(left / block, right / block, top / block, bottom / block) ||
               uneven_.none(left, right, top, bottom);
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
    /// Counts of what is uneven, of all above and to the left, so that four of them count any rectangle.
    struct Sums {
        std::size_t wide = 0;  ///< columns + 1
        std::vector<std::uint32_t> counts;

        template <class Uneven>
        void fill(std::size_t columns, std::size_t rows, Uneven uneven);
        /// Whether none is in the rectangle from the first to the last row and column.
        bool none(std::size_t left, std::size_t right, std::size_t top, std::size_t bottom) const {
            const std::uint32_t *above = &counts[top * wide], *below = &counts[(bottom + 1) * wide];
            return below[right + 1] - below[left] == above[right + 1] - above[left];
        }
    };

    static constexpr std::size_t block = 8;  ///< texels, in rows and columns
    void add_blend(float u, float v, float* rgb) const;

    int width_, height_;
    int stride_;                         ///< width + 2: the border is repeated once on every side
    std::vector<std::uint32_t> texels_;  ///< red, green, blue, flag; from the low byte
    Sums uneven_, uneven_blocks_;        ///< texels that are not flat, and blocks that hold such
    Colour gain_;                        ///< of a value in 0..255
    std::array<std::array<float, 256>, 3> seen_;
};

}  // namespace forage::bug
