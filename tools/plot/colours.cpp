#include "tools/plot/colours.h"

#include <algorithm>
#include <cmath>

namespace forage::plot {
namespace {

/// Red, green or blue, 0..255, of a colour such as 0xff8000.
int channel(int colour, int i) { return colour >> (16 - 8 * i) & 0xff; }

/// Interpolates between evenly spaced samples. `fraction` is in 0..1; a NaN counts as 0.
template <std::size_t N>
Colour between(const std::array<int, N>& samples, double fraction) {
    const double position =
        std::clamp(std::isnan(fraction) ? 0 : fraction, 0.0, 1.0) * static_cast<double>(N - 1);
    const auto low = std::min(static_cast<std::size_t>(position), N - 2);
    const double f = position - static_cast<double>(low);
    const auto mix = [&](int i) {
        return ((1 - f) * channel(samples[low], i) + f * channel(samples[low + 1], i)) / 255;
    };
    return {mix(0), mix(1), mix(2)};
}

constexpr std::array<int, 9> viridis = {0x440154, 0x472c7a, 0x3b518b, 0x2c718e, 0x21908d,
                                        0x27ad81, 0x5cc863, 0xaadc32, 0xfde725};
constexpr std::array<int, 5> blue_white_red = {0x2166ac, 0x92c5de, 0xf7f7f7, 0xf4a582, 0xb2182b};
constexpr std::array<int, 10> line_colours = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0x56b4e9,
                                              0xe69f00, 0x000000, 0xc8b914, 0x8c564b, 0x8c8c8c};

}  // namespace

Colour sequential(double fraction) { return between(viridis, fraction); }

Colour diverging(double value) { return between(blue_white_red, (value + 1) / 2); }

Colour category(std::size_t n) {
    const int c = line_colours[n % line_colours.size()];
    return {channel(c, 0) / 255.0, channel(c, 1) / 255.0, channel(c, 2) / 255.0};
}

}  // namespace forage::plot
