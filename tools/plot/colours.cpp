#include "tools/plot/colours.h"

#include <algorithm>
#include <cmath>

namespace forage::plot {
namespace {

/// Interpolates between evenly spaced samples (0..255). `fraction` is in 0..1; a NaN counts as 0.
template <std::size_t N>
Colour between(const std::array<std::array<int, 3>, N>& samples, double fraction) {
    const double position =
        std::clamp(std::isnan(fraction) ? 0 : fraction, 0.0, 1.0) * static_cast<double>(N - 1);
    const auto low = std::min(static_cast<std::size_t>(position), N - 2);
    const double f = position - static_cast<double>(low);
    const auto mix = [&](std::size_t i) {
        return ((1 - f) * samples[low][i] + f * samples[low + 1][i]) / 255;
    };
    return {mix(0), mix(1), mix(2)};
}

constexpr std::array<std::array<int, 3>, 9> viridis = {{{68, 1, 84},
                                                        {71, 44, 122},
                                                        {59, 81, 139},
                                                        {44, 113, 142},
                                                        {33, 144, 141},
                                                        {39, 173, 129},
                                                        {92, 200, 99},
                                                        {170, 220, 50},
                                                        {253, 231, 37}}};
constexpr std::array<std::array<int, 3>, 5> blue_white_red = {
    {{33, 102, 172}, {146, 197, 222}, {247, 247, 247}, {244, 165, 130}, {178, 24, 43}}};
constexpr std::array<std::array<int, 3>, 10> line_colours = {{{0, 114, 178},
                                                              {213, 94, 0},
                                                              {0, 158, 115},
                                                              {204, 121, 167},
                                                              {86, 180, 233},
                                                              {230, 159, 0},
                                                              {0, 0, 0},
                                                              {200, 185, 20},
                                                              {140, 86, 75},
                                                              {140, 140, 140}}};

}  // namespace

Colour sequential(double fraction) { return between(viridis, fraction); }

Colour diverging(double value) { return between(blue_white_red, (value + 1) / 2); }

Colour category(std::size_t n) {
    const auto& c = line_colours[n % line_colours.size()];
    return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0};
}

}  // namespace forage::plot
