// The behaviour of the robot with the reactive system.
#include <cmath>
#include <numbers>

#include "tests/support/catch.h"
#include "tests/support/closed_loop.h"

using namespace forage;
using namespace forage::test;

constexpr double up = std::numbers::pi / 2;

TEST_CASE("Without connections to the motors the robot stands still") {
    ClosedLoop loop({.system = "reactive_foraging_exercise.iqr"});
    const auto start = loop.pose();
    for (int i = 0; i < 500; ++i) loop.step();
    CHECK(std::hypot(loop.pose().x - start.x, loop.pose().y - start.y) < 0.01);
    CHECK(std::abs(loop.pose().yaw - start.yaw) < 0.01);
    CHECK(loop.world->trials(0).empty());
}

TEST_CASE("With only Explore connected to the motors, the robot drives straight past the light") {
    const auto only_explore =
        keep_connections({"c.const_speed-explore", "c.explore-motor_in", "c.motor_in-motor"});
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        ClosedLoop loop({.seed = seed, .edit_system = only_explore, .edit_world = start_at(-1.5, -2, up)});
        loop.run_trials(1);
        const auto& trial = loop.world->trials(0).front();
        CHECK(std::abs(trial.end.x + 1.5) < 0.02);  // straight up to the edge, noise aside
        CHECK(trial.end.y > 2.5);
        CHECK_FALSE(trial.reached_target);
    }
}

TEST_CASE("The complete system drives straight while nothing is in sight") {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        ClosedLoop loop({.seed = seed, .edit_world = start_at(-1.5, -2, up)});
        while (loop.pose().y < -0.5) loop.step();  // the light is at least 3.2 m away
        CHECK(std::abs(loop.pose().yaw - up) < 0.01);
        CHECK(std::abs(loop.pose().x + 1.5) < 0.02);
    }
}

TEST_CASE("The robot turns towards the light: right when it is on the right, left when it is on the left") {
    const double side = GENERATE(-1.5, 1.5);
    int turned = 0;
    constexpr int runs = 20;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        ClosedLoop loop({.seed = seed, .edit_world = start_at(side, 1.0, up)});
        loop.run_trials(1);
        const auto& end = loop.world->trials(0).front().end;
        turned +=
            side < 0 ? end.yaw < up - 0.3 && end.x > side + 0.5 : end.yaw > up + 0.3 && end.x < side - 0.5;
    }
    INFO("turned in " << turned << " of " << runs);
    CHECK(turned >= 19);
}
