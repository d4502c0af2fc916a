// Free driving compared with the original's rule: mean and standard deviation of the final pose.
//
// In each of N steps of dt = 1 ms the velocity plugin drives a robot with (v + a) along its heading and turns
// it with (w + b), a and b uniform in +-0.005 (m/s, rad/s), drawn in every step, also when the robot
// stands still. A uniform number of half width h has variance h^2 / 3, so s = 0.005 / sqrt(3) = 0.0028868.
// With the noise independent from step to step:
//
//   heading          mean w N dt                                spread s dt sqrt(N)
//   along a straight mean v N dt                                spread s dt sqrt(N)
//   across it        mean 0; v dt times the sum of the headings before, of which noise b_j is in N - j:
//                    spread v dt (s dt) sqrt(sum (N - j)^2) = v s dt^2 sqrt(N^3 / 3)
//   along an arc     x = v / w sin(w T), y = v / w (1 - cos(w T)), T = N dt, off by the steps' v w dt T / 2
//   at most
//
// N = 4000, v = 0.5: the heading and the distance have a spread of 1.826e-4, the position across of 2.108e-4.
// With n runs a mean is off by 4 spreads / sqrt(n) in 1 of 16 000, a spread by 4 / sqrt(2 n) of itself.
#include <array>
#include <cmath>
#include <vector>

#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;

namespace {

constexpr int runs = 500, steps = 4000;
constexpr double dt = 0.001;
const double s = 0.005 / std::sqrt(3.0);

struct Sample {
    std::vector<double> values;
    double mean() const {
        double sum = 0;
        for (const double v : values) sum += v;
        return sum / static_cast<double>(values.size());
    }
    double spread() const {
        double sum = 0;
        const double m = mean();
        for (const double v : values) sum += (v - m) * (v - m);
        return std::sqrt(sum / static_cast<double>(values.size() - 1));
    }
    void check(double expected_mean, double expected_spread, double bias = 0) const {
        CHECK(std::abs(mean() - expected_mean) <= 4 * expected_spread / std::sqrt(runs) + bias);
        CHECK(spread() == Approx(expected_spread).epsilon(4 / std::sqrt(2.0 * runs)));
    }
};

/// The pose of the robot in the open arena after 4 s, starting at the origin with the heading +x.
struct Drives {
    Sample x, y, yaw;
    explicit Drives(MotorCommand command) {
        const int cycles = GENERATE(100, 1);  // of 40 ms, or one of 4 s
        WorldDescription text = test::description("open_arena");
        test::find_model(text, "Bug")->pose = in_space({0, 0, 0});
        for (std::uint64_t seed = 1; seed <= runs; ++seed) {
            WorldOptions options;
            options.seed = seed, options.cycles_per_second = cycles / (steps * dt),
            options.real_time_factor = 1;
            const auto world = test::make_world(text, options);
            world->command(0, command);
            for (int cycle = 0; cycle < cycles; ++cycle) world->advance_bodies();
            REQUIRE(world->substeps() == steps);
            x.values.push_back(world->pose(0).x), y.values.push_back(world->pose(0).y);
            yaw.values.push_back(world->pose(0).yaw);
        }
    }
};

const double root = s * dt * std::sqrt(double{steps});

}  // namespace

TEST_CASE("Driving straight has the mean and the deviation of the original's noise") {
    const Drives d({0.5, 0});
    d.x.check(2, root);
    d.y.check(0, 0.5 * s * dt * dt * std::sqrt(std::pow(steps, 3) / 3));
    d.yaw.check(0, root);
}

TEST_CASE("Turning on the spot has the rate and the deviation of the original") {
    const Drives d({0, 0.7});
    d.yaw.check(2.8, root);
    CHECK(std::abs(d.x.mean()) < 4 * root / std::sqrt(runs));
}

TEST_CASE("Driving along an arc has the radius and the rate of the original") {
    const Drives d({0.5, 0.7});
    d.yaw.check(2.8, root);
    const double bias = 0.5 * 0.7 * dt * 4 / 2;
    CHECK(std::abs(d.x.mean() - 0.5 / 0.7 * std::sin(2.8)) < bias);
    CHECK(std::abs(d.y.mean() - 0.5 / 0.7 * (1 - std::cos(2.8))) < bias);
}

TEST_CASE("The noise also acts when the robot drives backwards or stands still") {
    const double speed = GENERATE(-0.5, 0.0);
    const Drives d({speed, 0});
    d.x.check(4 * speed, root);
    d.yaw.check(0, root);
}
