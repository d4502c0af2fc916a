#include "tools/plot/axes.h"

#include "tests/support/catch.h"

using namespace forage::plot;

namespace {

std::vector<std::string> names(const Ticks& ticks) {
    std::vector<std::string> out;
    for (const double v : ticks.at()) out.push_back(ticks.name(v));
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

TEST_CASE("The cells of a narrow table are rectangles that can be seen") {
    const auto wide = cell_size(400, 5, 560, 560, 28, 60), square = cell_size(20, 20, 560, 560, 28, 60);
    CHECK((wide.width == 1 && wide.height == 12));
    CHECK((square.width == 28 && square.height == 28));
    CHECK(cell_size(1, 5000, 560, 560, 28, 60).width == 28);
}
