#include "bug_interface/sensing/image_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <stdexcept>
#include <vector>

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

/// The weights of the source pixels from `first` on in a resampled pixel. Their sum is 1.
struct Window {
    int first;
    std::pmr::vector<double> weights;
};

/// The window of pixel `index` when a side of `from` pixels is resampled to `to` pixels. Shrinking widens the
/// filter. Pixels outside the picture have no weight.
Window window(int index, int from, int to, std::pmr::memory_resource* memory) {
    const double scale = static_cast<double>(to) / from, narrow = std::min(scale, 1.0), reach = 2 / narrow;
    const double centre = (index + 0.5) / scale;
    const int first = std::max(0, static_cast<int>(std::floor(centre - reach + 0.5)));
    const int end = std::min(static_cast<int>(centre + reach + 0.5), from);
    Window out{first, std::pmr::vector<double>(memory)};
    out.weights.reserve(static_cast<std::size_t>(end - first));
    double sum = 0;
    for (int i = first; i < end; ++i) {
        out.weights.push_back(cubic(narrow * (i + 0.5 - centre)));
        sum += out.weights.back();
    }
    for (double& weight : out.weights) weight /= sum;
    return out;
}

/// One resampled pixel, rounded to 8 bits. `step` is the distance between the source pixels in bytes.
std::array<std::uint8_t, 3> mix(const Window& window, const std::uint8_t* pixels, std::size_t step) {
    double sum[3] = {0, 0, 0};
    const std::uint8_t* pixel = pixels + static_cast<std::size_t>(window.first) * step;
    for (const double weight : window.weights) {
        for (int channel = 0; channel < 3; ++channel) sum[channel] += weight * pixel[channel];
        pixel += step;
    }
    std::array<std::uint8_t, 3> out;
    for (std::size_t channel = 0; channel < 3; ++channel)
        out[channel] = static_cast<std::uint8_t>(std::clamp(sum[channel] + 0.5, 0.0, 255.0));
    return out;
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

    void set(std::size_t cell, const std::uint8_t* pixel) const {
        if (pixel[0] == pixel[1] && pixel[1] == pixel[2] &&
            space == ColourSpace::hsv) {  // grey pixels are the most frequent ones
            first[cell] = second[cell] = 0;
            third[cell] = quirks.salt && pixel[0] == 1 ? 1.0 : units[pixel[0]];
            return;
        }
        const auto unit = [this](std::uint8_t v) { return quirks.salt && v == 1 ? 1.0 : units[v]; };
        const double r = unit(pixel[0]), g = unit(pixel[1]), b = unit(pixel[2]);
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

void resample(std::span<const std::uint8_t> rgb, int width, int height, int w, int h, const Cells& cells) {
    // The buffer is large enough for the pictures of a robot's camera; larger ones use the heap.
    std::array<std::byte, 32768> stack;
    std::pmr::monotonic_buffer_resource memory(stack.data(), stack.size());
    std::pmr::vector<Window> rows(&memory), columns(&memory);
    rows.reserve(static_cast<std::size_t>(h)), columns.reserve(static_cast<std::size_t>(w));
    for (int i = 0; i < h; ++i) rows.push_back(window(i, height, h, &memory));
    for (int i = 0; i < w; ++i) columns.push_back(window(i, width, w, &memory));
    std::pmr::vector<std::uint8_t> strip(3 * static_cast<std::size_t>(height),
                                         &memory);  // one resampled column with the rows of the source
    for (std::size_t column = 0; column < columns.size(); ++column) {
        for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
            const auto pixel = mix(columns[column], &rgb[3 * row * static_cast<std::size_t>(width)], 3);
            std::copy(pixel.begin(), pixel.end(), strip.begin() + static_cast<std::ptrdiff_t>(3 * row));
        }
        for (std::size_t row = 0; row < rows.size(); ++row)
            cells.set(row * columns.size() + column, mix(rows[row], strip.data(), 3).data());
    }
}

}  // namespace

void image_cells(std::span<const std::uint8_t> rgb, int width, int height, ColourSpace space, int w, int h,
                 std::span<double> first, std::span<double> second, std::span<double> third,
                 const ImageQuirks& quirks) {
    if (width < 1 || height < 1 || w < 1 || h < 1)
        throw std::invalid_argument("a picture needs at least one pixel");
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto wanted = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
    if (rgb.size() < 3 * pixels || first.size() < wanted || second.size() < wanted || third.size() < wanted)
        throw std::invalid_argument("a span is shorter than its picture");
    const Cells cells{space, quirks, first, second, third};
    const bool same = w == width && h == height;
    if (!same && (quirks.always_resample || (w != width && h != height)))
        return resample(rgb, width, height, w, h, cells);
    if (w > width || h > height) throw std::invalid_argument("cannot crop a picture to more than it has");
    std::size_t cell = 0;
    for (int row = height - h; row < height; ++row)
        for (int column = 0; column < w; ++column)
            cells.set(cell++, &rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(column))]);
}

}  // namespace forage::bug
