// differenceModule and directionModule.
#include <cmath>

#include "modules/difference/difference.h"
#include "modules/direction/direction.h"
#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using namespace forage::goal;
using Eigen::ArrayXd;

namespace {

ArrayXd one_hot(Index size, Index cell) {
    ArrayXd out = ArrayXd::Zero(size);
    out[cell] = 1;
    return out;
}

}  // namespace

TEST_CASE(
    "The peak is the first of the most active cells; there is none if all cells are equal or none is above "
    "0") {
    ArrayXd cells = ArrayXd::Zero(6);
    CHECK_FALSE(peak_position(cells, 3));
    cells.setConstant(0.5);
    CHECK_FALSE(peak_position(cells, 3));
    cells << -1, -2, -3, -1, -1, -1;
    CHECK_FALSE(peak_position(cells, 3));
    cells << 0, 0, 0.1, 0, 0.4, 0.4;
    CHECK(*peak_position(cells, 3) == GridPosition{1, 1});
    cells << 0, 0, 0.4, 0, 0.4 + 1e-12, 0;  // equal in single precision
    CHECK(*peak_position(cells, 3) == GridPosition{0, 2});
}

TEST_CASE("The difference is one cell, which is the centre at the goal") {
    ArrayXd out = ArrayXd::Constant(5 * 3, 7);
    show_difference(GridPosition{1, 2}, GridPosition{1, 2}, 3, 2, out);
    CHECK((out == one_hot(15, 1 * 5 + 2)).all());
    show_difference(GridPosition{1, 0}, GridPosition{0, 2}, 3, 2, out);
    CHECK((out == one_hot(15, 0 * 5 + 4)).all());
    show_difference(std::nullopt, GridPosition{0, 0}, 3, 2, out);
    CHECK(out.isZero());
    for (Index a = 0; a < 6; ++a)
        for (Index b = 0; b < 6; ++b) {
            show_difference(GridPosition{a / 3, a % 3}, GridPosition{b / 3, b % 3}, 3, 2, out);
            CHECK(out.sum() == 1);
        }
}

TEST_CASE("differenceModule requires two groups of the same size") {
    ModuleBench b(module_type<DifferenceModule>());
    b.in("_location", 3, 2).in("_goal", 3, 2).out("_diff", 5, 3);
    CHECK(b.problems().empty());
    b.start();
    b.inputs[0] = one_hot(6, 4);
    b.inputs[1] = one_hot(6, 0);
    b.update();
    CHECK((b.outputs[0] == one_hot(15, 1)).all());

    ModuleBench wrong(module_type<DifferenceModule>());
    wrong.in("_location", 3, 2).in("_goal", 2, 3).out("_diff", 3, 2);
    const auto all = wrong.problems();
    REQUIRE(all.size() == 2);
    CHECK_THAT(all[0].message, ContainsSubstring("'_goal' needs the size of '_location'"));
    CHECK_THAT(all[1].message, ContainsSubstring("'_diff' needs twice the width and height"));
}

TEST_CASE("Bearings decrease around the circle: left, top, right, bottom") {
    const GridPosition here{5, 5};
    CHECK(bearing(here, {5, 2}) == 1);
    CHECK(bearing(here, {2, 5}) == Approx(0.75));
    CHECK(bearing(here, {5, 9}) == Approx(0.5));
    CHECK(bearing(here, {9, 5}) == Approx(0.25));
    CHECK(bearing(here, {3, 3}) == Approx(0.875));
    CHECK(bearing(here, {7, 7}) == Approx(0.375));
    CHECK(std::isnan(bearing(here, here)));
    CHECK(distance(here, {2, 1}) == 5);
}

TEST_CASE("A turn increases with the angle and has the direction of the shorter way") {
    CHECK(turn(0.52, 0.5) == 0.5);
    CHECK(turn(0.57, 0.5) == 0.6);
    CHECK(turn(0.43, 0.5) == 0.4);
    CHECK(turn(0.62, 0.5) == Approx(0.83));
    CHECK(turn(0.9, 0.5) == 0.95);
    CHECK(turn(0.98, 0.02) == 0.5);
    CHECK(turn(0.05, 0.98) == Approx(0.6));
    CHECK(turn(0.98, 0.05) == Approx(0.4));
    CHECK(turn(std::nan(""), 0.5) == Approx(0.05));  // at the goal, as in the original
}

TEST_CASE(
    "directionModule shows one direction for every pair of places, and none for a place that is not known") {
    ModuleBench b(module_type<DirectionModule>());
    b.in("_location", 4, 3).in("_ori", 16, 1).in("_goal", 4, 3).out("_dir", 9, 1).out("_dist", 1, 1);
    CHECK(b.problems().empty());
    b.start();
    b.update();
    CHECK(b.outputs[0].isZero());
    for (Index location = 0; location < 12; ++location)
        for (Index goal = 0; goal < 12; ++goal)
            for (Index orientation = 0; orientation < 16; ++orientation) {
                b.inputs[0] = one_hot(12, location), b.inputs[1] = one_hot(16, orientation),
                b.inputs[2] = one_hot(12, goal);
                b.update();
                if (b.outputs[0].sum() != 1 || (b.outputs[1][0] == 0) != (location == goal))
                    FAIL(location << ' ' << goal);
            }
    b.inputs[0].setZero();
    b.update();
    CHECK(b.outputs[0].isZero());
    CHECK(b.outputs[1][0] == 0);
}

TEST_CASE(
    "directionModule goes straight on when the orientation is the bearing, and reports which group is "
    "wrong") {
    ModuleBench b(module_type<DirectionModule>());
    b.in("_location", 3, 3).in("_ori", 5, 1).in("_goal", 3, 3).out("_dir", 9, 1).out("_dist", 1, 1).start();
    b.inputs[0] = one_hot(9, 3), b.inputs[2] = one_hot(9, 5),
    b.inputs[1] = one_hot(5, 2);  // goal to the right
    b.update();
    CHECK((b.outputs[0] == one_hot(9, 4)).all());
    CHECK(b.outputs[1][0] == 2);

    ModuleBench wrong(module_type<DirectionModule>());
    wrong.in("_location", 3, 3).in("_ori", 1, 1).in("_goal", 3, 2).out("_dir", 9, 1).out("_dist", 1, 1);
    const auto all = wrong.problems();
    REQUIRE(all.size() == 2);
    CHECK_THAT(all[0].message, ContainsSubstring("'_ori' needs at least 2 cells"));
    CHECK_THAT(all[1].message, ContainsSubstring("'_goal' needs the size of '_location'"));
}
