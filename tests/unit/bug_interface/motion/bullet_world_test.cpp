#include "bug_interface/motion/bullet_world.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "tests/support/catch.h"
#include "tests/support/overlap.h"

using namespace forage::bug;

namespace {

Outline random_outline(const forage::RandomStream& random, std::uint64_t index) {
    std::array<double, 6> u{};
    random.uniform(index, u);
    const double yaw = 2 * std::numbers::pi * u[2];
    Outline o;
    o.round = u[3] < 0.5;
    o.x = 10 + u[0], o.y = -10 + u[1], o.cos_yaw = std::cos(yaw), o.sin_yaw = std::sin(yaw);
    o.half_x = 0.05 + 0.4 * u[4], o.half_y = 0.05 + 0.1 * u[5], o.radius = 0.1 + 0.2 * u[4];
    return o;
}

}  // namespace

TEST_CASE("Gaps that Bullet finds are those of discs and rectangles in the plane") {
    const forage::RandomStream random(1, "gaps");
    int found = 0, apart = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const Outline a = random_outline(random, 2 * i), b = random_outline(random, 2 * i + 1);
        const double within = i % 2 ? 0.05 : 0;
        const Overlap expected = overlap(b, a);
        const BulletWorld::Gap gap = BulletWorld(0).gap(a, b, within);
        INFO("pair " << i << ": " << gap.distance << " m instead of " << -expected.depth);
        if (-expected.depth > within + 1e-5) {
            ++apart;
            REQUIRE(gap.distance > within - 1e-5);
            continue;
        }
        ++found;
        if (a.round || b.round || within == 0) {
            REQUIRE(gap.distance == Approx(-expected.depth).margin(1e-5));
            if (expected.depth < 0.02) REQUIRE(gap.normal.dot(expected.normal) > 0.999);
        } else {
            REQUIRE(gap.distance < 1e-5 - expected.depth);
        }
    }
    CHECK(found > 5000);
    CHECK(apart > 1000);
}

TEST_CASE("A solution does not depend on the solutions before") {
    BulletWorld used(2), fresh(2);
    Outline wall, disc;
    wall.x = 0.3, wall.half_x = 0.1, wall.half_y = 5;
    disc.round = true, disc.radius = 0.2;
    const auto solve = [&](BulletWorld& world, double speed) {
        world.begin({});
        world.add_body(1, {}, 5, 1, {speed, 0.3, 0});
        world.add_contacts(disc, 1, wall, BulletWorld::no_body, 0.1, 0.1);
        world.solve(0.02);
        Velocity v{speed, 0.3, 0};
        world.update(1, v);
        return v;
    };
    for (const double speed : {1.0, -0.5, 2.0}) solve(used, speed);
    const Velocity v = solve(fresh, 0.7);
    CHECK(solve(used, 0.7) == v);
    CHECK(v.x == Approx(0).margin(1e-6));
    CHECK(v.y == Approx(0.3 - 0.1 * 0.7).margin(1e-5));
    CHECK(v.turn < 0);
}
