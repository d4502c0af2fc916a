#include "bug_interface/sensing/outline.h"

#include "tests/unit/bug_interface/sensing/arena.h"

using namespace forage::bug;
using forage::bug::test::at;

TEST_CASE("The cross-section of a rotated box is a rectangle with the same rotation") {
    const auto o = cross_section({ShapeKind::box, at(1, 2, 0.125, 0.5), {5, 0.2, 0.25}}, 0.175);
    REQUIRE(o);
    CHECK_FALSE(o->round);
    CHECK(o->x == 1);
    CHECK(o->y == 2);
    CHECK(o->cos_yaw == Approx(std::cos(0.5)));
    CHECK(o->sin_yaw == Approx(std::sin(0.5)));
    CHECK(o->half_x == 2.5);
    CHECK(o->half_y == 0.1);
}

TEST_CASE("A plane above or below a solid has no cross-section with it") {
    CHECK_FALSE(cross_section({ShapeKind::box, at(0, 0, 0.125), {5, 0.2, 0.25}}, 0.35));
    CHECK_FALSE(cross_section({ShapeKind::cylinder, at(0, 0, 0.35), {0.5, 0.5, 0.25}}, 0.175));
    CHECK(cross_section({ShapeKind::cylinder, at(0, 0, 0.35), {0.5, 0.5, 0.25}}, 0.35)->radius == 0.25);
    CHECK_FALSE(cross_section({ShapeKind::sphere, at(0, 0, 0.06), {0.16, 0.16, 0.16}}, 0.175));
}

TEST_CASE("The cross-section of a sphere is smaller away from its centre") {
    const auto o = cross_section({ShapeKind::sphere, at(0, 0, 0.06), {0.16, 0.16, 0.16}}, 0.08);
    REQUIRE(o);
    CHECK(o->round);
    CHECK(o->radius == Approx(std::sqrt(0.08 * 0.08 - 0.02 * 0.02)));
}
