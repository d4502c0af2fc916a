#include "modules/direction/direction.h"

#include <cmath>

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
