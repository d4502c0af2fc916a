// Pictures, and the cells of groups that show them.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace forage::video {

constexpr int longest_side = 4096;  ///< of a picture, pixels

/// A picture of 8 bits per channel: red, green and blue of each pixel, in rows from the top.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Red, green and blue of each cell of a group, 0 to 1: columns 0 to 2.
using Cells = Eigen::Array<double, Eigen::Dynamic, 3>;

/// A picture in the size of a group. A cell is the mean of the pixels that it covers, by area.
Cells resampled(const Picture& picture, int width, int height);

/// Settings of a picture. 50 is neutral; 0 and 100 are none of it and twice of it, for brightness half a
/// scale less and more.
struct Adjustment {
    double brightness = 50, contrast = 50, saturation = 50;
};
/// Changes the saturation, the contrast around the middle, and then the brightness. The results are 0 to 1.
void adjust(Cells& cells, const Adjustment& adjustment);

/// Replaces red, green and blue by their luminance (ITU-R BT.601).
void make_grey(Cells& cells);
/// Replaces red, green and blue by hue, saturation and value, 0 to 1. The hue of a grey cell is 0.
void make_hsv(Cells& cells);
/// The opposite of make_hsv().
void make_rgb(Cells& cells);

}  // namespace forage::video
