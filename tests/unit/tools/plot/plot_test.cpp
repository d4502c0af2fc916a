#include <cstring>

#include "tests/support/catch.h"
#include "tools/plot/axes.h"
#include "tools/plot/cairo_handle.h"
#include "tools/plot/connection.h"
#include "tools/plot/heat.h"
#include "tools/plot/layers.h"
#include "tools/plot/lines.h"
#include "tools/plot/plots.h"
#include "tools/plot/space.h"
#include "tools/plot/time.h"

using forage::Estimate;
using namespace forage::plot;

namespace {

std::vector<std::string> names(const Ticks& ticks) {
    std::vector<std::string> out;
    for (const double v : ticks.at()) out.push_back(ticks.name(v));
    return out;
}

/// Distance in CIE L*, the perceived brightness.
double lightness(const Colour& c) {
    const auto linear = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

SpacePlot small_group(std::size_t frames) {
    SpacePlot p;
    p.title = "P/G:act", p.quantity = "Activity";
    p.grid = {1, 1, 3, 2, false};
    for (std::size_t i = 0; i < frames; ++i)
        p.frames.push_back({i * 10, {0, 1, 2, 3, 4, static_cast<double>(i)}});
    return p;
}

/// The number of pixels of a picture in which no part differs from a colour by more than `tolerance`, 0..255.
int pixels_of(const Picture& picture, const Colour& colour, int tolerance = 0) {
    const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(picture.width),
                                                          static_cast<int>(picture.height)));
    const CairoContext context(cairo_create(surface.get()));
    Canvas canvas(context.get());
    picture.draw(canvas);
    cairo_surface_flush(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    int out = 0;
    for (int y = 0; y < static_cast<int>(picture.height); ++y)
        for (int x = 0; x < static_cast<int>(picture.width); ++x) {
            const unsigned char* bgr = cairo_image_surface_get_data(surface.get()) + y * stride + 4 * x;
            const auto near = [&](int i, double v) { return std::abs(bgr[i] - v * 255) <= tolerance + 0.5; };
            out += near(2, colour.r) && near(1, colour.g) && near(0, colour.b);
        }
    return out;
}

}  // namespace

TEST_CASE("Ticks are round numbers within the interval, and their labels have as many digits as necessary") {
    using V = std::vector<std::string>;
    CHECK(names({{0, 1}, 5}) == V{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
    CHECK(names({{-3, 3}, 6}) == V{"-3", "-2", "-1", "0", "1", "2", "3"});
    CHECK(names({{0, 0.00125}, 5}) == V{"0.0000", "0.0005", "0.0010"});
    CHECK(names({{0.5, 3.5}, 9, true}) == V{"1", "2", "3"});
    CHECK(names({{0, 5e7}, 5}) == V{"0", "1e+07", "2e+07", "3e+07", "4e+07", "5e+07"});
    CHECK(names({{2, 2}, 5}).empty());
}

TEST_CASE("Even steps of a value are even steps of brightness") {
    double last = lightness(sequential(0));
    for (int i = 1; i <= 20; ++i) {
        const double now = lightness(sequential(i / 20.0));
        CHECK(now - last > 2);
        CHECK(now - last < 6);
        last = now;
    }
    for (const double v : {0.3, 0.6, 1.0})
        CHECK(lightness(diverging(v)) == Approx(lightness(diverging(-v))).margin(9));
}

TEST_CASE("All lines of a time plot have different colours") {
    for (std::size_t a = 0; a < 10; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const Colour x = category(a), y = category(b);
            CHECK(std::abs(x.r - y.r) + std::abs(x.g - y.g) + std::abs(x.b - y.b) > 0.2);
        }
}

TEST_CASE("A colour scale has zero at its end, or in its middle when there are values below it") {
    ColourScale positive;
    positive.include(2), positive.include(4);
    CHECK((positive.interval().low == 0 && positive.interval().high == 4));
    ColourScale both;
    both.include(-1), both.include(3), both.include(std::nan(""));
    CHECK((both.interval().low == -3 && both.interval().high == 3));
    CHECK(both(0).r == Approx(both(0).b));
    CHECK(ColourScale().interval().size() > 0);
}

TEST_CASE("A curve of any length stays small and loses no peak") {
    Curve curve("c");
    for (int i = 0; i < 1'000'000; ++i) curve.add(i, i == 123'457 ? 9 : i == 700'001 ? -7 : 1);
    CHECK(curve.bins().size() <= 4000);
    double low = 0, high = 0, count = 0, last = -1;
    for (const auto& b : curve.bins()) {
        low = std::min(low, b.low), high = std::max(high, b.high), count += b.count;
        CHECK(b.first > last);
        last = b.last;
    }
    CHECK((low == -7 && high == 9 && count == 1'000'000 && last == 999'999));
}

TEST_CASE("A picture of rows outlives its curves and shows how many cells share a row") {
    const auto drawn = [](std::size_t cells_per_row) {
        std::vector<Curve> curves(30, Curve("", row_bins));
        for (auto& c : curves)
            for (int i = 0; i < 5000; ++i) c.add(i, i);
        CHECK(curves[0].bins().size() <= row_bins);
        TimePlot plot;
        plot.title = "a", plot.quantity = "b", plot.curves = curves, plot.cells_per_row = cells_per_row;
        return time_plot(plot);
    };
    const Picture one = drawn(1), seven = drawn(7);
    CHECK(one.height == seven.height);
    CHECK(render(one, Format::png) != render(seven, Format::png));
}

TEST_CASE("A picture is the same in all formats, and the same bytes whatever was drawn before") {
    TimePlot time;
    time.title = "a", time.quantity = "b";
    std::vector<Curve> curves(12, Curve("c"));
    for (int c = 0; c < 12; ++c)
        for (int i = 0; i < 50; ++i) curves[static_cast<std::size_t>(c)].add(i, c * i);
    time.curves = curves;
    for (const Format f : {Format::png, Format::svg, Format::pdf}) {
        const std::string first = render(space_plot(small_group(1)), f);
        CHECK(first.size() > 1000);
        render(time_plot(time), f);
        CHECK(render(space_plot(small_group(1)), f) == first);
    }
    CHECK(format_of("a.svg") == Format::svg);
    CHECK(format_of("a.b") == std::nullopt);
}

TEST_CASE("An animation is a GIF file of all its frames, and the same bytes each time") {
    auto frames = space_animation(small_group(3));
    const std::string gif = render_animation(frames, 0.5);
    CHECK(gif.starts_with("GIF89a"));
    CHECK(gif.ends_with(';'));
    CHECK(render_animation(frames, 0.5) == gif);
    CHECK(render_animation({frames[0], frames[1]}, 0.5).size() < gif.size());
    frames.back().width += 10;
    CHECK_THROWS(render_animation(frames, 0.5));
}

TEST_CASE("Text that does not fit is cut between characters") {
    Measure measure;
    const std::string umlauts = "ÄÖÜÄÖÜÄÖÜ";
    for (double width = 5; width < 120; width += 3) {
        const std::string cut = measure.canvas().fitted(umlauts, 12, width);
        CHECK((cut == umlauts || cut.ends_with("…")));
        CHECK((cut == umlauts || (cut.size() - 3) % 2 == 0));
    }
    CHECK(measure.canvas().fitted("short", 12, 500) == "short");
}

TEST_CASE("A connection of large groups is drawn in a picture of bounded size") {
    ConnectionPlot p;
    p.title = "a", p.source = "A", p.target = "B";
    p.source_shape = {100, 50, 5000}, p.target_shape = {3, 1, 3};
    p.pre = {0, 4999, 4999}, p.post = {0, 2, 2}, p.strength = {1, -1, 0.5}, p.delay = {0, 3, 1};
    const Picture picture = connection_plot(p);
    CHECK(picture.width < 1600);  // two matrices, as there is a delay
    CHECK(picture.height < 800);
    CHECK(render(picture, Format::png).size() > 1000);
}

TEST_CASE("Where a line has no number there is a gap, and a line without any number is not drawn") {
    const auto drawn = [](std::optional<Estimate> middle, std::optional<Estimate> second) {
        LinesPlot p;
        p.title = "a";
        p.lines = {{"x", {{0, Estimate{1, 1, 1}}, {1, middle}, {2, Estimate{1, 1, 1}}}},
                   {"y", {{0, second}, {1, second}, {2, second}}}};
        return lines_plot(p);
    };
    const Estimate one{1, 1, 1}, two{2, 2, 2};
    CHECK(pixels_of(drawn(one, two), category(0), 90) > 2 * pixels_of(drawn({}, two), category(0), 90));
    CHECK(pixels_of(drawn(one, two), category(1), 90) > 500);
    CHECK(pixels_of(drawn(one, {}), category(1), 60) == 0);
}

TEST_CASE("A heat map marks the cells without a number") {
    HeatMap map;
    map.x_names = {"1", "2"}, map.y_names = {"3"};
    map.cells = {Estimate{0.5, 0, 1, 3}, Estimate{1, 1, 1, 3}};
    CHECK(pixels_of(heat_map(map), pale) == 0);
    map.cells[0].reset();
    CHECK(pixels_of(heat_map(map), pale) > 5000);
    const int with_all = pixels_of(heat_map(map), black);
    map.cells[1]->count = 2, map.cells[0] = Estimate{0.5, 0, 1, 3};
    CHECK(pixels_of(heat_map(map), black) != with_all);
}

TEST_CASE("The cells of a narrow table are rectangles that can be seen") {
    const auto wide = cell_size(400, 5, 560, 560, 28, 60), square = cell_size(20, 20, 560, 560, 28, 60);
    CHECK((wide.width == 1 && wide.height == 12));
    CHECK((square.width == 28 && square.height == 28));
    CHECK(cell_size(1, 5000, 560, 560, 28, 60).width == 28);
}

TEST_CASE("The rows of a time plot have the names of their cells") {
    const auto drawn = [](int x, int y) {
        forage::observe::Recorded what;
        what.name = "P/G:act", what.cells = {x, y, 4, 3, {}}, what.group_width = 9;
        RowPlot plot(
            *[] {
                forage::Diagnostics diagnostics;
                return parse_plot("time:P/G", "plot", diagnostics);
            }(),
            what);
        plot.add(0, std::vector<double>(12, 1));
        plot.add(1, std::vector<double>(12, 2));
        return plot.draw(Format::svg, {});
    };
    CHECK(drawn(1, 1) == drawn(1, 1));
    CHECK(drawn(1, 1) != drawn(1, 2));
    CHECK(drawn(1, 1) != drawn(2, 1));
}

TEST_CASE("Layers put a box below all boxes from which arrows lead to it") {
    const auto rows = [](const Layers& layers) {
        std::vector<int> out;
        for (const auto& p : layers.boxes) out.push_back(p.row);
        return out;
    };
    const auto chain =
        layered(4, {{2, 0}, {0, 1}, {2, 1}, {1, 1}, {1, 3}, {3, 0}});  // 3 to 0 closes a circle
    CHECK(rows(chain) == std::vector{1, 2, 0, 3});
    CHECK(chain.bends[0].empty());
    REQUIRE(chain.bends[2].size() == 1);  // from 2 to 1, past 0
    CHECK(chain.bends[2][0].row == 1);
    CHECK(chain.bends[2][0].column != chain.boxes[0].column);
    CHECK(rows(layered(2, {{0, 1}, {1, 0}})) == std::vector{0, 1});
    std::vector<std::pair<std::size_t, std::size_t>> star;
    for (std::size_t i = 1; i < 15; ++i) star.emplace_back(0, i);
    const auto wide = rows(layered(15, star));
    CHECK(*std::max_element(wide.begin(), wide.end()) == 3);
    // Arrows do not cross when they need not.
    const auto pairs = layered(4, {{0, 3}, {1, 2}});
    CHECK((pairs.boxes[0].column < pairs.boxes[1].column) == (pairs.boxes[3].column < pairs.boxes[2].column));
}
