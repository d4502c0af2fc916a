// Figures with several panels.
#include "tools/plot/figure.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace forage;
using namespace forage::plot;

namespace {

Picture panel(double width, double height) {
    return {width, height, [](Canvas& canvas) { canvas.text(5, 15, "panel", 11); }};
}

}  // namespace

TEST_CASE("panels stand row by row, in columns as wide as the widest") {
    const auto f = figure({panel(100, 50), panel(200, 80), panel(150, 60)}, {2, 2});
    CHECK(f.width == 150 + 16 + 200);
    CHECK(f.height == 80 + 22 + 16 + 60 + 22);
    const auto svg = render(f, Format::svg);
    CHECK(svg.starts_with("<?xml"));
}

TEST_CASE("a figure is as wide as asked for, and embeds its fonts") {
    const auto f = scaled(figure({panel(100, 50), panel(200, 80)}, {1, 2}), {180}, Format::pdf);
    CHECK(std::abs(f.width - 180 * 96 / 25.4) < 1e-9);
    CHECK(std::abs(f.height / f.width - (80.0 + 22) / 316) < 1e-9);
    const auto pdf = render(f, Format::pdf);
    CHECK(pdf.find("/FontFile") != pdf.npos);
}

TEST_CASE("layouts are read") {
    Diagnostics none;
    const auto layout = parse_layout("2x13", none);
    CHECK(none.all().empty());
    CHECK((layout->rows == 2 && layout->columns == 13));
    for (const char* wrong : {"", "2", "x", "2x", "0x1", "-1x2", "2x2x2", "27x1", "a x b"}) {
        Diagnostics found;
        CHECK_FALSE(parse_layout(wrong, found));
        CHECK(found.errors() == 1);
    }
}

TEST_CASE("widths are in mm or pixels, with 300 dots per inch in PNG") {
    Diagnostics none;
    CHECK(parse_width("85", none)->value == 85);
    CHECK_FALSE(parse_width("85mm", none)->in_pixels);
    CHECK(scaled(panel(100, 50), *parse_width("600px", none), Format::svg).height == 300);
    CHECK(std::abs(scaled(panel(100, 50), {25.4}, Format::png).width - 300) < 1e-9);
    CHECK(std::abs(scaled(panel(100, 50), {25.4}, Format::svg).width - 96) < 1e-9);
    CHECK(none.all().empty());
    for (const char* wrong : {"", "wide", "9", "2001mm", "39px", "85 cm", "nan", "85mmmm", "-85"}) {
        Diagnostics found;
        CHECK_FALSE(parse_width(wrong, found));
        CHECK(found.errors() == 1);
    }
}
