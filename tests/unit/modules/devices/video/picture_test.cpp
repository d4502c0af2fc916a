// Pictures, their cells and their stream.
#include "modules/devices/video/picture.h"

#include "modules/devices/video/ppm.h"
#include "tests/support/catch.h"

using namespace forage::video;

namespace {

Picture picture(int width, int height, std::vector<std::uint8_t> greys) {
    Picture out{width, height, {}};
    for (const auto g : greys) out.rgb.insert(out.rgb.end(), {g, g, g});
    return out;
}

Cells cell(double r, double g, double b) {
    Cells out(1, 3);
    out << r, g, b;
    return out;
}

bool close(const Cells& a, const Cells& b) { return (a - b).abs().maxCoeff() < 1e-12; }

}  // namespace

TEST_CASE("A cell is the mean of the pixels that it covers") {
    const Picture p = picture(4, 2, {0, 255, 255, 255, 0, 0, 255, 0});
    CHECK(resampled(p, 4, 2)(1, 0) == 1);
    CHECK(resampled(p, 1, 1)(0, 0) == Approx(0.5));
    const Cells halves = resampled(p, 2, 1);
    CHECK(halves(0, 0) == Approx(0.25));
    CHECK(halves(1, 0) == Approx(0.75));
    const Cells thirds = resampled(p, 3, 1);  // a pixel belongs to two cells by area
    CHECK(thirds(0, 0) == Approx((0 + 1 / 3.0 * 0.5) / (4 / 3.0)));
    CHECK(thirds(1, 0) == Approx((2 / 3.0 * 0.5 + 2 / 3.0 * 1) / (4 / 3.0)));
    CHECK(resampled(p, 8, 4)(2, 0) == 1);  // smaller cells repeat pixels
    CHECK(resampled(p, 7, 5).mean() == Approx(0.5));
}

TEST_CASE("Hue, saturation and value, and back") {
    const double sixth = 1 / 6.0;
    for (const auto& [rgb, hsv] : {std::pair{cell(1, 0, 0), cell(0, 1, 1)},
                                   {cell(0, 1, 0), cell(2 * sixth, 1, 1)},
                                   {cell(0, 0, 0.5), cell(4 * sixth, 1, 0.5)},
                                   {cell(0.5, 0.5, 0.5), cell(0, 0, 0.5)},
                                   {cell(0, 0, 0), cell(0, 0, 0)},
                                   {cell(1, 0.5, 0.5), cell(0, 0.5, 1)},
                                   {cell(1, 0, 1), cell(5 * sixth, 1, 1)},
                                   {cell(1, 1, 0), cell(sixth, 1, 1)}}) {
        Cells there = rgb;
        make_hsv(there);
        CHECK(close(there, hsv));
        make_rgb(there);
        CHECK(close(there, rgb));
    }
}

TEST_CASE("Adjustments: 50 changes nothing, and the results are 0 to 1") {
    const auto adjusted = [](Cells cells, const Adjustment& a) { return adjust(cells, a), cells; };
    const Cells c = cell(0.75, 0.5, 0.25);
    CHECK((adjusted(c, {}) == c).all());
    CHECK(close(adjusted(c, {75, 50, 50}), cell(1, 0.75, 0.5)));
    CHECK(close(adjusted(c, {50, 100, 50}), cell(1, 0.5, 0)));
    CHECK(close(adjusted(c, {50, 0, 50}), cell(0.5, 0.5, 0.5)));
    Cells grey = c;
    make_grey(grey);
    CHECK(close(adjusted(c, {50, 50, 0}), grey));
    CHECK((adjusted(c, {100, 100, 50}) <= 1).all());
}

TEST_CASE("A stream of pictures arrives in pieces") {
    const std::string first = "P6\n2 1\n255\nabcdef", second = "P6 1 1 255 xyz";
    PpmStream stream;
    std::vector<Picture> seen;
    for (const char c : first + second) {
        stream.add({&c, 1});
        if (auto p = stream.next()) seen.push_back(*p);
    }
    REQUIRE(seen.size() == 2);
    CHECK(seen[0].width == 2);
    CHECK(seen[0].rgb == std::vector<std::uint8_t>{'a', 'b', 'c', 'd', 'e', 'f'});
    CHECK(seen[1].rgb == std::vector<std::uint8_t>{'x', 'y', 'z'});
    CHECK(stream.empty());
}

TEST_CASE("What is not a picture is an error") {
    for (const std::string text : {"P5\n2 1\n255\nabcdef", "P6\n0 1\n255\n", "P6\n5000 1\n255\n",
                                   "P6\n2 1\n65535\n", "P6\n-1 1\n255\n"}) {
        PpmStream stream;
        stream.add(text);
        CHECK_THROWS(stream.next());
    }
    PpmStream endless;
    endless.add(std::string(1000, 'P'));
    CHECK_THROWS(endless.next());
    PpmStream blanks;
    blanks.add(std::string(1000, ' '));
    CHECK_THROWS(blanks.next());
}
