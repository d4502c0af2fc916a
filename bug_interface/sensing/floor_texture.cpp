#include "bug_interface/sensing/floor_texture.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace forage::bug {
namespace {

Image one_pixel() { return {1, 1, {255, 255, 255}}; }

}  // namespace

template <class Uneven>
void FloorTexture::Sums::fill(std::size_t columns, std::size_t rows, Uneven uneven) {
    wide = columns + 1;
    counts.assign((rows + 1) * wide, 0);
    for (std::size_t row = 0; row < rows; ++row) {
        std::uint32_t in_row = 0;
        for (std::size_t column = 0; column < columns; ++column) {
            in_row += uneven(column, row) ? 1 : 0;
            counts[(row + 1) * wide + column + 1] = counts[row * wide + column + 1] + in_row;
        }
    }
}

FloorTexture::FloorTexture(const Colour& colour) : FloorTexture(one_pixel(), colour) {}

FloorTexture::FloorTexture(const Image& image, const Colour& gain)
    : width_(image.width), height_(image.height), stride_(image.width + 2), gain_(gain / 255.0f) {
    const cv::Mat picture(height_, width_, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
    cv::Mat four_channels;
    cv::cvtColor(picture, four_channels, cv::COLOR_RGB2RGBA);
    texels_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_ + 2));
    cv::Mat packed(height_ + 2, stride_, CV_8UC4, texels_.data());
    cv::copyMakeBorder(four_channels, packed, 1, 1, 1, 1, cv::BORDER_REPLICATE);

    const auto stride = static_cast<std::size_t>(stride_);
    constexpr std::uint32_t flag = 0xff000000u;
    const auto colour = [&](std::size_t i) { return texels_[i] & ~flag; };
    for (std::size_t i = 0; i < texels_.size(); ++i) {
        const bool last = i + stride + 1 >= texels_.size();  // never the upper left of a lookup
        const bool is_flat = last || (colour(i) == colour(i + 1) && colour(i) == colour(i + stride) &&
                                      colour(i) == colour(i + stride + 1));
        texels_[i] = colour(i) | (is_flat ? flag : 0);
    }
    const auto rows = static_cast<std::size_t>(height_ + 2);
    uneven_.fill(stride, rows,
                 [&](std::size_t column, std::size_t row) { return !flat(texels_[row * stride + column]); });
    uneven_blocks_.fill((stride + block - 1) / block, (rows + block - 1) / block,
                        [&](std::size_t column, std::size_t row) {
                            const std::size_t left = column * block, top = row * block;
                            return !uneven_.none(left, std::min(left + block, stride) - 1, top,
                                                 std::min(top + block, rows) - 1);
                        });
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t value = 0; value < 256; ++value)
            seen_[channel][value] =
                std::min(1.0f, gain_[static_cast<Eigen::Index>(channel)] * static_cast<float>(value));
}

void FloorTexture::add_blend(float u, float v, float* rgb) const {
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
