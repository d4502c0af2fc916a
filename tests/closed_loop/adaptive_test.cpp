// What the adaptive layer learns with the robot in the loop: statistics with fixed seeds.
#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/learning.h"

using namespace forage;
using namespace forage::test;

TEST_CASE("Without learning the robot drives straight on from all positions") {
    for (const auto seed : learning_seeds) {
        DacLoop loop("basic_arena", seed, {"Adaptive.eta=0"});
        loop.run_trials(12);
        for (const auto& t : loop.world->trials(0)) {
            INFO("seed " << seed << ", trial " << t.number);
            CHECK(std::abs(t.end.x - t.start.x) < 0.1);  // 4.5 m on: a start heading is up to 0.01 rad off
            CHECK(t.end.y > 2.5);
        }
    }
}

TEST_CASE("With the file's learning rate the robot learns the basic arena") {
    for (const auto seed : learning_seeds) {
        DacLoop loop("basic_arena", seed);
        loop.run_trials(300);
        INFO("seed " << seed);
        CHECK(loop.success(50) >= 0.9);
        CHECK(loop.activity("Adaptive/discrepancy")[0] < 0.1);
    }
}

TEST_CASE("The adaptive layer alone cannot learn the ambiguous arena") {
    for (const auto seed : learning_seeds) {
        DacLoop loop("ambiguous_arena", seed);
        loop.run_trials(300);
        INFO("seed " << seed);
        CHECK(loop.success(100) < 0.7);  // it goes where it went last: better than never turning, 0.33
    }
}
