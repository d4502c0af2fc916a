// The complete DAC system before learning. learning_test.py tests what the system learns.
#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/closed_loop.h"

using namespace forage;
using namespace forage::test;

TEST_CASE("Without learning, the robot drives straight from all start poses") {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        ClosedLoop loop({.system = "dac_foraging.iqr", .seed = seed, .set = {"Adaptive.eta=0"}});
        loop.run_trials(12);
        for (const auto& t : loop.world->trials(0)) {
            INFO("seed " << seed << ", trial " << t.number);
            CHECK(std::abs(t.end.x - t.start.x) < 0.1);  // 4.5 m on: a start heading is up to 0.01 rad off
            CHECK(t.end.y > 2.5);
        }
    }
}
