// The statistics of trials in the arenas, with fixed seeds.
#include <array>
#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/closed_loop.h"

using namespace forage;
using namespace forage::test;

TEST_CASE("The reactive system reaches the target in most trials") {
    const std::string world = GENERATE("worlds/basic_arena.world", "worlds/ambiguous_arena.world");
    int reached = 0;
    constexpr int trials = 60, seeds = 3;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        ClosedLoop loop({.world = world, .seed = seed});
        loop.run_trials(trials);
        for (const auto& t : loop.world->trials(0)) reached += t.reached_target;
    }
    INFO(reached << " of " << trials * seeds);
    CHECK(reached >= 0.9 * trials * seeds);
}

TEST_CASE("A trial ends at the edge of the arena and the next one starts at one of the three positions") {
    ClosedLoop loop({.seed = 5});
    constexpr std::size_t trials = 150;
    loop.run_trials(trials);
    std::array<int, 3> starts{};
    const auto& all = loop.world->trials(0);
    CHECK(all[0].start.x == Approx(0).margin(1e-9));  // the first start pose is that of the world file
    for (std::size_t i = 0; i < trials; ++i) {
        const auto& t = all[i];
        CHECK(std::max(std::abs(t.end.x), std::abs(t.end.y)) > 2.5);
        CHECK(std::max(std::abs(t.end.x), std::abs(t.end.y)) < 2.502);  // detected within a step of 1 ms
        if (i == 0) continue;
        const double column = std::round(t.start.x / 1.5);
        REQUIRE(std::abs(column) <= 1);
        CHECK(std::abs(t.start.x - 1.5 * column) <= 0.01);
        CHECK(std::abs(t.start.y + 2) <= 0.01);
        CHECK(std::abs(t.start.yaw - 1.57079) <= 0.01);
        ++starts[static_cast<std::size_t>(column + 1)];
        // A reset takes 1001 steps of 1 ms, which is 12 or 13 cycles of 80 ms.
        const auto pause = t.first_cycle - (all[i - 1].first_cycle + all[i - 1].cycles);
        CHECK((pause >= 11 && pause <= 13));
    }
    // Each position a third of the time: chi-squared with 2 degrees of freedom, below its 0.999 quantile.
    double chi2 = 0;
    for (const int n : starts) chi2 += std::pow(n - (trials - 1) / 3.0, 2) / ((trials - 1) / 3.0);
    CHECK(chi2 < 13.8);
}

TEST_CASE("The same seed gives the same run, and another seed gives another run") {
    const auto run = [](std::uint64_t seed) {
        ClosedLoop loop({.seed = seed});
        for (int i = 0; i < 400; ++i) loop.step();
        return std::pair(loop.pose().x, Eigen::ArrayXd(loop.activity("Bug/Light")));
    };
    const auto a = run(7), b = run(7), c = run(8);
    CHECK(a.first == b.first);
    CHECK((a.second == b.second).all());
    CHECK(a.first != c.first);
    CHECK((a.second != c.second).any());
}

TEST_CASE("The n-th start pose of a seed does not depend on the robot's behaviour") {
    ClosedLoop sees({.seed = 4}),
        blind({.seed = 4,
               .edit_system =
                   keep_connections({"c.const_speed-explore", "c.explore-motor_in", "c.motor_in-motor"})});
    sees.run_trials(20);
    blind.run_trials(20);
    bool differs = false;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto &a = sees.world->trials(0)[i], &b = blind.world->trials(0)[i];
        CHECK((a.start.x == b.start.x && a.start.y == b.start.y && a.start.yaw == b.start.yaw));
        differs = differs || a.cycles != b.cycles;
    }
    CHECK(differs);
}

TEST_CASE("Noise can be turned off; then the light group is silent where there is no light") {
    ClosedLoop loop({.noise = false});
    for (int i = 0; i < 10; ++i) loop.step();
    CHECK(loop.activity("Bug/Light").maxCoeff() == 0);
    CHECK(loop.activity("Bug/Sensor").maxCoeff() == 0);
}
