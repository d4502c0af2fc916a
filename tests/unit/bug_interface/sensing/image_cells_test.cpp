#include "bug_interface/sensing/image_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/catch.h"

using namespace forage::bug;

namespace {

constexpr int width = 32, height = 28;
using Picture = std::vector<std::uint8_t>;

struct Groups {
    std::vector<double> first, second, third;
    Groups(const Picture& rgb, ColourSpace space, int w, int h, const ImageQuirks& quirks = {})
        : first(static_cast<std::size_t>(w * h)), second(first), third(first) {
        ImageCells(width, height, w, h, quirks).fill(rgb, space, first, second, third);
    }
};

/// The red channel is the column, the green one the row.
Picture coordinates() {
    Picture out;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            for (const int v : {column, row, 200}) out.push_back(static_cast<std::uint8_t>(v));
    return out;
}

Picture uniform(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Picture out;
    for (int i = 0; i < width * height; ++i) out.insert(out.end(), {r, g, b});
    return out;
}

std::array<double, 3> one_pixel(ColourSpace space, std::uint8_t r, std::uint8_t g, std::uint8_t b,
                                ImageQuirks quirks = {}) {
    const Picture pixel = {r, g, b};
    std::array<double, 3> out;
    ImageCells(1, 1, 1, 1, quirks).fill(pixel, space, {&out[0], 1}, {&out[1], 1}, {&out[2], 1});
    return out;
}

void check(const std::array<double, 3>& got, double a, double b, double c) {
    CHECK(got[0] == Approx(a).margin(1e-12));
    CHECK(got[1] == Approx(b).margin(1e-12));
    CHECK(got[2] == Approx(c).margin(1e-12));
}

}  // namespace

TEST_CASE("A picture of the size of the groups is copied cell by cell") {
    const Groups g(coordinates(), ColourSpace::rgb, 32, 28);
    CHECK(g.first[0] == 0);
    CHECK(g.first[31] == 31 / 255.0);
    CHECK(g.second[32 * 27 + 5] == 27 / 255.0);
    CHECK(g.third[77] == 200 / 255.0);
}

TEST_CASE(
    "Groups with the width or the height of the picture crop it to the left columns and the bottom rows") {
    const Groups narrow(coordinates(), ColourSpace::rgb, 28, 28);
    CHECK(narrow.first[27] == 27 / 255.0);
    CHECK(narrow.second[28 * 27] == 27 / 255.0);
    const Groups low(coordinates(), ColourSpace::rgb, 32, 24);
    CHECK(low.second[0] == 4 / 255.0);
    CHECK(low.second[32 * 23] == 27 / 255.0);
    CHECK(low.first[31] == 31 / 255.0);
}

TEST_CASE("Groups that differ in width and height receive a resampled picture") {
    const Groups half(coordinates(), ColourSpace::rgb, 16, 14);
    for (std::size_t row = 2; row < 12; ++row)
        for (std::size_t column = 2; column < 14;
             ++column) {  // a linear slope stays linear, except for rounding
            CHECK(half.first[row * 16 + column] * 255 == Approx(2.0 * double(column) + 0.5).margin(0.51));
            CHECK(half.second[row * 16 + column] * 255 == Approx(2.0 * double(row) + 0.5).margin(0.51));
        }
    for (const double v : half.third) CHECK(v == 200 / 255.0);
}

TEST_CASE("A step keeps the undershoot of the cubic kernel with B = C = 1/3") {
    Picture step = uniform(100, 0, 0);
    for (int row = 0; row < height; ++row)
        for (int column = 16; column < width; ++column)
            step[3 * static_cast<std::size_t>(row * width + column)] = 200;
    const Groups half(step, ColourSpace::rgb, 16, 14);
    const auto mitchell = [](double x) {
        return x < 1 ? (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6
                     : (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6;
    };
    // Cell 7 lies 1 pixel before the edge, so pixels beyond it are 0.75, 1.25, 1.75 kernel units away; cell 6
    // lies 3 pixels before it and has one such pixel, at 1.75, where the kernel is negative.
    CHECK(half.first[7] * 255 ==
          Approx(100 + 100 * (mitchell(0.75) + mitchell(1.25) + mitchell(1.75)) / 2).margin(0.51));
    CHECK(half.first[6] * 255 == Approx(100 + 100 * mitchell(1.75) / 2).margin(0.51));
    CHECK(half.first[6] < 100 / 255.0);
    CHECK(half.first[9] > 200 / 255.0);
}

TEST_CASE("A resampled picture has the bytes of one pixel at a time, columns first") {
    const auto kernel = [](double x) {
        x = std::abs(x);
        if (x < 1) return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
        if (x < 2) return (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6;
        return 0.0;
    };
    // One line of `from` pixels, each `step` numbers after the one before, resampled to `to` pixels.
    const auto line = [&](const std::vector<int>& in, std::size_t begin, std::size_t step, int from, int to) {
        std::vector<int> out;
        const double scale = double(to) / from, narrow = std::min(scale, 1.0), reach = 2 / narrow;
        for (int i = 0; i < to; ++i) {
            const double centre = (i + 0.5) / scale;
            const int first = std::max(0, int(std::floor(centre - reach + 0.5))),
                      end = std::min(int(centre + reach + 0.5), from);
            double all = 0, sum = 0;
            for (int k = first; k < end; ++k) all += kernel(narrow * (k + 0.5 - centre));
            for (int k = first; k < end; ++k)
                sum += kernel(narrow * (k + 0.5 - centre)) / all * in[begin + std::size_t(k) * step];
            out.push_back(int(std::clamp(sum + 0.5, 0.0, 255.0)));
        }
        return out;
    };
    std::mt19937 chance(3);
    for (const auto& [w, h] : {std::pair{9, 8}, {16, 14}, {5, 27}, {31, 3}, {1, 1}, {40, 30}}) {
        Picture picture;
        std::vector<int> numbers;
        for (int i = 0; i < 3 * width * height; ++i) {
            numbers.push_back(int(chance() % (chance() % 4 == 0 ? 2 : 256)));
            picture.push_back(static_cast<std::uint8_t>(numbers.back()));
        }
        const Groups got(picture, ColourSpace::rgb, w, h);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::vector<int> narrow(std::size_t(w * height));
            for (std::size_t row = 0; row < height; ++row) {
                const auto pixels = line(numbers, 3 * row * width + channel, 3, width, w);
                std::copy(pixels.begin(), pixels.end(), narrow.begin() + std::ptrdiff_t(row) * w);
            }
            const auto& cells = channel == 0 ? got.first : channel == 1 ? got.second : got.third;
            int wrong = 0;
            for (std::size_t column = 0; column < std::size_t(w); ++column) {
                const auto pixels = line(narrow, column, std::size_t(w), height, h);
                for (std::size_t row = 0; row < std::size_t(h); ++row)
                    wrong += cells[row * std::size_t(w) + column] != pixels[row] / 255.0;
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("Resampling can be forced") {
    ImageQuirks quirks;
    quirks.always_resample = true;
    const Groups g(coordinates(), ColourSpace::rgb, 16, 28, quirks);
    CHECK(g.first[8] * 255 == Approx(16.5).margin(0.51));
}

TEST_CASE("Hue, saturation and value follow the sector formula") {
    const auto hsv = ColourSpace::hsv;
    check(one_pixel(hsv, 0, 0, 0), 0, 0, 0);
    check(one_pixel(hsv, 255, 255, 255), 0, 0, 1);
    check(one_pixel(hsv, 255, 0, 0), 0, 1, 1);
    check(one_pixel(hsv, 255, 255, 0), 1.0 / 6, 1, 1);
    check(one_pixel(hsv, 0, 255, 0), 1.0 / 3, 1, 1);
    check(one_pixel(hsv, 0, 255, 255), 0.5, 1, 1);
    check(one_pixel(hsv, 0, 0, 255), 2.0 / 3, 1, 1);
    check(one_pixel(hsv, 255, 0, 255), 5.0 / 6, 1, 1);
    check(one_pixel(hsv, 255, 0, 128), 0.9163398693, 1, 1);
    check(one_pixel(hsv, 51, 102, 51), 1.0 / 3, 0.5, 0.4);
}

TEST_CASE("Grey uses the original's weights, so white is above 1") {
    const double white = 0.2126 + 0.7512 + 0.0722;
    check(one_pixel(ColourSpace::grey, 255, 255, 255), white, white, white);
    check(one_pixel(ColourSpace::grey, 0, 51, 0), 0.7512 * 0.2, 0.7512 * 0.2, 0.7512 * 0.2);
    ImageQuirks meant;
    meant.grey_green = 0.7152;
    check(one_pixel(ColourSpace::grey, 255, 255, 255, meant), 1, 1, 1);
}

TEST_CASE("The option `salt` turns the value 1 into 1.0") {
    ImageQuirks salt;
    salt.salt = true;
    check(one_pixel(ColourSpace::rgb, 1, 0, 2), 1 / 255.0, 0, 2 / 255.0);
    check(one_pixel(ColourSpace::rgb, 1, 0, 2, salt), 1, 0, 2 / 255.0);
}

TEST_CASE("Impossible sizes are rejected") {
    CHECK_THROWS_AS(Groups(coordinates(), ColourSpace::rgb, 40, 28), std::invalid_argument);
    std::vector<double> few(10), enough(32 * 28);
    CHECK_THROWS_AS(
        ImageCells(width, height, 32, 28).fill(coordinates(), ColourSpace::rgb, few, enough, enough),
        std::invalid_argument);
}
