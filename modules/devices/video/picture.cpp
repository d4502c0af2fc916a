#include "modules/devices/video/picture.h"

#include <algorithm>
#include <cmath>

namespace forage::video {
namespace {

/// The part of one line of pixels that a cell covers: pixels first to last, of which the ends may be cut.
struct Span {
    int first, last;
    double first_weight, last_weight;
    double weight(int i) const { return i == first ? first_weight : i == last ? last_weight : 1; }
};

std::vector<Span> spans(int pixels, int cells) {
    std::vector<Span> out;
    for (int i = 0; i < cells; ++i) {
        // Whole numbers keep neighbouring cells from overlapping by a rounding error.
        const std::int64_t begin = std::int64_t{i} * pixels, end = std::int64_t{i + 1} * pixels;
        const int first = static_cast<int>(begin / cells), last = static_cast<int>((end - 1) / cells);
        const auto covered = [&](int pixel) {
            const auto from = std::max<std::int64_t>(begin, std::int64_t{pixel} * cells),
                       to = std::min<std::int64_t>(end, std::int64_t{pixel + 1} * cells);
            return static_cast<double>(to - from) / cells;
        };
        out.push_back({first, last, covered(first), covered(last)});
    }
    return out;
}

}  // namespace

Cells resampled(const Picture& picture, int width, int height) {
    const auto columns = spans(picture.width, width), rows = spans(picture.height, height);
    const double area =
        static_cast<double>(picture.width) / width * (static_cast<double>(picture.height) / height);
    Cells out(Eigen::Index{width} * height, 3);
    Eigen::Index cell = 0;
    for (const auto& row : rows)
        for (const auto& column : columns) {
            double sum[3] = {};
            for (int y = row.first; y <= row.last; ++y) {
                const std::uint8_t* p =
                    &picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                      static_cast<std::size_t>(column.first))];
                for (int x = column.first; x <= column.last; ++x, p += 3) {
                    const double weight = row.weight(y) * column.weight(x);
                    for (int c = 0; c < 3; ++c) sum[c] += weight * p[c];
                }
            }
            for (int c = 0; c < 3; ++c) out(cell, c) = sum[c] / (255 * area);
            ++cell;
        }
    return out;
}

void adjust(Cells& cells, const Adjustment& a) {
    const double more = (a.brightness - 50) / 100, contrast = a.contrast / 50, saturation = a.saturation / 50;
    if (more == 0 && contrast == 1 && saturation == 1) return;
    for (Eigen::Index i = 0; i < cells.rows(); ++i) {
        const double grey = 0.299 * cells(i, 0) + 0.587 * cells(i, 1) + 0.114 * cells(i, 2);
        for (int c = 0; c < 3; ++c) {
            const double saturated = grey + saturation * (cells(i, c) - grey);
            cells(i, c) = std::clamp(0.5 + contrast * (saturated - 0.5) + more, 0.0, 1.0);
        }
    }
}

void make_grey(Cells& cells) {
    for (Eigen::Index i = 0; i < cells.rows(); ++i)
        cells.row(i).setConstant(0.299 * cells(i, 0) + 0.587 * cells(i, 1) + 0.114 * cells(i, 2));
}

void make_hsv(Cells& cells) {
    for (Eigen::Index i = 0; i < cells.rows(); ++i) {
        const double r = cells(i, 0), g = cells(i, 1), b = cells(i, 2);
        const double high = std::max({r, g, b}), range = high - std::min({r, g, b});
        double hue = 0;  // in sixths of the circle
        if (range > 0) {
            hue = high == r ? (g - b) / range : high == g ? 2 + (b - r) / range : 4 + (r - g) / range;
            if (hue < 0) hue += 6;
        }
        cells.row(i) << hue / 6, high > 0 ? range / high : 0, high;
    }
}

void make_rgb(Cells& cells) {
    for (Eigen::Index i = 0; i < cells.rows(); ++i) {
        const double h = cells(i, 0) * 6, s = cells(i, 1), v = cells(i, 2);
        const auto channel = [&](double n) {
            const double k = std::fmod(n + h, 6.0);
            return v - v * s * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
        };
        const double r = channel(5), g = channel(3), b = channel(1);
        cells.row(i) << r, g, b;
    }
}

}  // namespace forage::video
