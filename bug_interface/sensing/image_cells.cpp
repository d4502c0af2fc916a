#include "bug_interface/sensing/image_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "bug_interface/sensing/four.h"
#include "core/base/simd.h"

namespace forage::bug {
namespace {

/// The filter of Mitchell and Netravali, "Reconstruction filters in computer graphics", SIGGRAPH 1988, with B
/// = C = 1/3.
double cubic(double x) {
    x = std::abs(x);
    if (x < 1) return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
    if (x < 2) return (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6;
    return 0;
}

constexpr std::size_t channels = 4;  ///< of a pixel: red, green, blue and an unused one, side by side
constexpr std::size_t together = 4;  ///< pixels that are summed side by side
constexpr std::size_t padded(std::size_t pixels) { return (pixels + together - 1) / together * together; }

/// Writes the sum of four numbers, rounded to 0..255.
[[gnu::always_inline]] inline void write_level(const Four& sum, double* to) {
    typedef std::int32_t Integers __attribute__((vector_size(4 * sizeof(std::int32_t))));  // NOLINT
    Four level = sum + 0.5;
    level = level < 0 ? four(0) : level;
    level = level > 255 ? four(255) : level;
    store(__builtin_convertvector(__builtin_convertvector(level, Integers), Four), to);
}

/// Resamples one side of `together` lines of pixels that lie side by side, where the next pixel of a line
/// comes after `step` numbers. The terms of each sum are added in their order. In `to`, the next pixel of a
/// line comes after `to_step` numbers, and the next line after `to_line`.
FORAGE_SIMD void mix(const ResampledSide& side, const double* from, std::size_t step, double* to,
                     std::size_t to_step, std::size_t to_line) {
    for (const ResampledSide::Window& w : side.windows) {
        const double *weights = &side.weights[w.first_weight], *at = from + step * w.first;
        Four a{}, b{}, c{}, d{};  // not an array, which GCC 12 would not keep in registers
        for (std::size_t k = 0; k < w.count; ++k, at += step) {
            const Four weight = four(weights[k]);
            a += weight * load(at), b += weight * load(at + channels);
            c += weight * load(at + 2 * channels), d += weight * load(at + 3 * channels);
        }
        write_level(a, to), write_level(b, to + to_line);
        write_level(c, to + 2 * to_line), write_level(d, to + 3 * to_line);
        to += to_step;
    }
}

/// value / 255 for each 8-bit value.
constexpr std::array<double, 256> units = [] {
    std::array<double, 256> out{};
    for (std::size_t value = 0; value < out.size(); ++value) out[value] = static_cast<double>(value) / 255;
    return out;
}();

double hue(double r, double g, double b, double max, double span) {
    if (span == 0) return 0;
    double sector = max == r ? (g - b) / span : max == g ? 2 + (b - r) / span : 4 + (r - g) / span;
    if (sector < 0) sector += 6;
    return sector / 6;
}

/// Writes converted pixels to the three groups.
struct Cells {
    ColourSpace space;
    const ImageQuirks& quirks;
    std::span<double> first, second, third;

    void set(std::size_t cell, std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
        const auto unit = [this](std::uint8_t v) { return quirks.salt && v == 1 ? 1.0 : units[v]; };
        if (red == green && green == blue &&
            space == ColourSpace::hsv) {  // grey pixels are the most frequent ones
            first[cell] = second[cell] = 0;
            third[cell] = unit(red);
            return;
        }
        const double r = unit(red), g = unit(green), b = unit(blue);
        if (space == ColourSpace::rgb) {
            first[cell] = r, second[cell] = g, third[cell] = b;
        } else if (space == ColourSpace::hsv) {
            const double max = std::max({r, g, b}), span = max - std::min({r, g, b});
            first[cell] = hue(r, g, b, max, span);
            second[cell] = max > 0 ? span / max : 0;
            third[cell] = max;
        } else {
            first[cell] = second[cell] = third[cell] = 0.2126 * r + quirks.grey_green * g + 0.0722 * b;
        }
    }
};

}  // namespace

/// Shrinking widens the filter. Pixels outside the picture have no weight; the weights of a window have the
/// sum 1.
ResampledSide::ResampledSide(std::size_t from, std::size_t to) {
    const double scale = static_cast<double>(to) / static_cast<double>(from), narrow = std::min(scale, 1.0),
                 reach = 2 / narrow;
    for (std::size_t index = 0; index < to; ++index) {
        const double centre = (static_cast<double>(index) + 0.5) / scale;
        const int first = std::max(0, static_cast<int>(std::floor(centre - reach + 0.5)));
        const int end = std::min(static_cast<int>(centre + reach + 0.5), static_cast<int>(from));
        const std::size_t first_weight = weights.size();
        double sum = 0;
        for (int i = first; i < end; ++i) {
            weights.push_back(cubic(narrow * (i + 0.5 - centre)));
            sum += weights.back();
        }
        for (std::size_t k = first_weight; k < weights.size(); ++k) weights[k] /= sum;
        windows.push_back({static_cast<std::size_t>(first), weights.size() - first_weight, first_weight});
    }
}

ImageCells::ImageCells(int width, int height, int w, int h, const ImageQuirks& quirks)
    : width_(static_cast<std::size_t>(width)),
      height_(static_cast<std::size_t>(height)),
      w_(static_cast<std::size_t>(w)),
      h_(static_cast<std::size_t>(h)),
      quirks_(quirks),
      resampled_((w != width || h != height) && (quirks.always_resample || (w != width && h != height))) {
    if (width < 1 || height < 1 || w < 1 || h < 1)
        throw std::invalid_argument("a picture needs at least one pixel");
    if (!resampled_) {
        if (w > width || h > height) throw std::invalid_argument("cannot crop a picture to more than it has");
        return;
    }
    columns_ = ResampledSide(width_, w_), rows_ = ResampledSide(height_, h_);
    source_.resize(channels * together * width_);
    narrow_.resize(channels * padded(w_) * padded(height_));
    result_.resize(channels * padded(w_) * h_);
}

/// Resamples the rows of the picture, four at a time, then the columns of the result.
void ImageCells::resample(const std::uint8_t* rgb) {
    constexpr std::size_t four_pixels = channels * together;
    const std::size_t wide = channels * padded(w_);
    for (std::size_t row = 0; row < height_; row += together) {
        for (std::size_t line = 0; line < std::min(together, height_ - row); ++line)
            for (std::size_t column = 0; column < width_; ++column, rgb += 3)
                for (std::size_t i = 0; i < 3; ++i)
                    source_[four_pixels * column + channels * line + i] = rgb[i];
        mix(columns_, source_.data(), four_pixels, &narrow_[wide * row], channels, wide);
    }
    for (std::size_t first = 0; first < wide; first += four_pixels)
        mix(rows_, &narrow_[first], wide, &result_[first], wide, channels);
}

void ImageCells::fill(std::span<const std::uint8_t> rgb, ColourSpace space, std::span<double> first,
                      std::span<double> second, std::span<double> third) {
    const std::size_t wanted = w_ * h_;
    if (rgb.size() < 3 * width_ * height_ || first.size() < wanted || second.size() < wanted ||
        third.size() < wanted)
        throw std::invalid_argument("a span is shorter than its picture");
    const Cells cells{space, quirks_, first, second, third};
    std::size_t cell = 0;
    if (resampled_) {
        resample(rgb.data());
        const auto byte = [](double level) { return static_cast<std::uint8_t>(level); };
        for (std::size_t row = 0; row < h_; ++row) {
            const double* pixel = &result_[channels * row * padded(w_)];
            for (std::size_t column = 0; column < w_; ++column, pixel += channels)
                cells.set(cell++, byte(pixel[0]), byte(pixel[1]), byte(pixel[2]));
        }
        return;
    }
    for (std::size_t row = height_ - h_; row < height_; ++row)
        for (std::size_t column = 0; column < w_; ++column) {
            const std::uint8_t* pixel = &rgb[3 * (row * width_ + column)];
            cells.set(cell++, pixel[0], pixel[1], pixel[2]);
        }
}

}  // namespace forage::bug
