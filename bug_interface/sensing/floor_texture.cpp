#include "bug_interface/sensing/floor_texture.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>
#include <utility>

#include "core/base/simd.h"

namespace forage::bug {
namespace {

/// Clears the flag of all texels of a row that differ from their right, lower or lower right neighbour.
FORAGE_SIMD void mark_flat(std::uint32_t* __restrict here, const std::uint32_t* __restrict below,
                           std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t differ =
            (here[i] ^ here[i + 1]) | (here[i] ^ below[i]) | (here[i] ^ below[i + 1]);
        here[i] &= differ ? 0x00ffffffu : ~0u;
    }
}

/// The bitwise and of `count` texels, which is fast for 8 of them.
std::uint32_t common_bits(const std::uint32_t* texels, std::size_t count) {
    if (count != 8) return std::accumulate(texels, texels + count, ~0u, std::bit_and());
    std::uint64_t pairs[4];
    std::memcpy(pairs, texels, sizeof pairs);
    const std::uint64_t all = (pairs[0] & pairs[1]) & (pairs[2] & pairs[3]);
    return static_cast<std::uint32_t>(all & all >> 32);
}

}  // namespace

FloorTexture::FloorTexture(const Colour& colour) : FloorTexture({1, 1, 1, Pixels(9, ~0u)}, colour) {}

FloorTexture::FloorTexture(Image image, const Colour& gain)
    : width_(image.width),
      height_(image.height),
      stride_(image.width + 2),
      texels_(std::move(image.pixels)),
      gain_(gain / 255.0f) {
    // Pixels are opaque, so that all flags are set at first. The last row and column are never the upper left
    // texels of an interpolation.
    const auto stride = static_cast<std::size_t>(stride_), rows = static_cast<std::size_t>(height_ + 2);
    for (std::size_t row = 0; row + 1 < rows; ++row)
        mark_flat(&texels_[row * stride], &texels_[(row + 1) * stride], stride - 1);
    not_flat_ = BitGrid(stride, rows, [&](std::size_t column, std::size_t row, std::size_t count) {
        const std::uint32_t* here = &texels_[row * stride + column];
        unsigned bits = 0;
        if (!flat(common_bits(here, count)))  // mostly all are flat
            for (std::size_t i = 0; i < count; ++i) bits |= (flat(here[i]) ? 0u : 1u) << i;
        return bits;
    });
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t value = 0; value < 256; ++value)
            visible_[channel][value] =
                std::min(1.0f, gain_[static_cast<Eigen::Index>(channel)] * static_cast<float>(value));
}

void FloorTexture::add_interpolated(float u, float v, float* rgb) const {
    u += 0.5f, v += 0.5f;
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const float right = u - static_cast<float>(column), low = v - static_cast<float>(row);
    const std::uint32_t* t = &texels_[static_cast<std::size_t>(row * stride_ + column)];
    const float weights[4] = {(1 - low) * (1 - right), (1 - low) * right, low * (1 - right), low * right};
    const std::uint32_t corners[4] = {t[0], t[1], t[stride_], t[stride_ + 1]};
    for (int channel = 0; channel < 3; ++channel) {
        float value = 0;
        for (int i = 0; i < 4; ++i)
            value += weights[i] * static_cast<float>(corners[i] >> (8 * channel) & 255u);
        rgb[channel] += std::min(1.0f, gain_[channel] * value);
    }
}

}  // namespace forage::bug
