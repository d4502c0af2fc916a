// The published order of control, allostatic and cautious agent, in a kinematic arena of walls, a mate and a
// predator. Measures and bounds: Guerrero-Rosado et al., ALIFE 2025, whose tables have 20 trials of 2000 s.
#include <cmath>
#include <numbers>

#include "core/types/cell_model.h"
#include "modules/allostasis/module.h"
#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using namespace forage::allostasis;

namespace {

constexpr double wall_m = 1.75, body_m = 0.05, cycle_s = 0.04, degree = std::numbers::pi / 180;
constexpr double angles[8] = {-17, -49, -90, -150, 150, 90, 49, 17};  // of the range sensors, degrees

/// A robot with two wheels, in the original's metres.
struct Body {
    double x, y, heading;
    double range(int sensor) const {
        const double c = std::cos(heading + angles[sensor] * degree),
                     s = std::sin(heading + angles[sensor] * degree);
        const double along_x = (c > 0 ? wall_m - x : wall_m + x) / std::max(std::abs(c), 1e-9);
        const double along_y = (s > 0 ? wall_m - y : wall_m + y) / std::max(std::abs(s), 1e-9);
        return std::clamp(std::min(along_x, along_y) - body_m, 0.0, 0.3);
    }
    void move(const Wheels& w) {
        const double v = 0.01 * (w.right + w.left);
        heading += 0.3846 * (w.right - w.left) * cycle_s;
        x = std::clamp(x + v * std::cos(heading) * cycle_s, body_m - wall_m, wall_m - body_m);
        y = std::clamp(y + v * std::sin(heading) * cycle_s, body_m - wall_m, wall_m - body_m);
    }
};

struct Measures {
    double efficiency = 0, fairness = 0, stability = 0, security = 0;
};

Measures trial(bool control, double security_priority, std::uint64_t seed) {
    ModuleBench b(module_type<AllostasisModule>());
    b.in("gps", 3, 1).in("mate", 3, 1).in("predator", 3, 1).in("proximity", 32, 1);
    b.out("needs", 5, 1);
    b.bind("forces", true, 0, 0, 0).bind("views", true, 0, 0, 0);
    b.out("motor", 41, 41);
    for (const char* p : {"time", "errors", "balance"}) b.bind(p, true, 0, 0, 0);
    b.set("Control", control ? "true" : "false").set("Security Priority", std::to_string(security_priority));
    b.seed(seed).start();
    const RandomStream random(seed, "walks");
    Body robot{0, 0, std::numbers::pi / 2},
        others[2] = {{-1.5, 0, -std::numbers::pi / 2}, {1.5, 0, -std::numbers::pi / 2}};
    RandomWalk walks[2];
    Measures m;
    const std::uint64_t cycles = 50000;
    for (std::uint64_t t = 0; t < cycles; ++t) {
        const auto gps = [](Eigen::ArrayXd& cells, const Body& at) {
            cells << 4 * at.x + 10, 4 * at.y + 10, at.heading + std::numbers::pi;
        };
        gps(b.inputs[0], robot), gps(b.inputs[1], others[0]), gps(b.inputs[2], others[1]);
        for (const auto& [cell, sensor] : {std::pair{17, 0}, {20, 1}, {11, 6}, {14, 7}})
            b.inputs[3][cell] = 1 - (robot.range(sensor) * 4 + 0.2) / 2;
        b.update();
        Index best = 0;
        b.outputs[3].maxCoeff(&best);
        const double forward = (20.0 - static_cast<double>(best / 41)) / 20 * fastest_wheel;
        const double left = (20.0 - static_cast<double>(best % 41)) / 20 * fastest_wheel;
        robot.move({forward + left, forward - left});
        for (std::uint32_t i = 0; i < 2; ++i) {
            Eigen::Array<double, 8, 1> ranges;
            for (int k = 0; k < 8; ++k) ranges[k] = others[i].range(k);
            const auto z = [&](std::uint32_t k) {
                return normal(random.uniform(t, 8 * i + 2 * k), random.uniform(t, 8 * i + 2 * k + 1));
            };
            others[i].move(walks[i].step(ranges, {z(0), z(1)}, i == 0 ? mate_walk : predator_walk));
        }
        const auto& x = b.outputs[0];
        m.efficiency += x.mean(), m.fairness += 1 - (x.maxCoeff() - x.minCoeff());
        m.stability += 1 - (1 - x).square().mean(), m.security += x[security];
    }
    for (double* v : {&m.efficiency, &m.fairness, &m.stability, &m.security})
        *v /= static_cast<double>(cycles);
    return m;
}

Measures mean_of(const std::vector<Measures>& all) {
    Measures m;
    for (const auto& a : all) {
        const auto n = static_cast<double>(all.size());
        m.efficiency += a.efficiency / n, m.fairness += a.fairness / n;
        m.stability += a.stability / n, m.security += a.security / n;
    }
    return m;
}

}  // namespace

TEST_CASE(
    "The allostatic agent keeps its needs in balance, the control agent does not; caution buys security",
    "[long]") {
    std::vector<Measures> control, allostatic, cautious;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        control.push_back(trial(true, 1, seed));
        allostatic.push_back(trial(false, 1, seed));
        cautious.push_back(trial(false, 2, seed));
    }
    for (const auto& a : allostatic)  // every trial against every trial
        for (const auto& c : control) {
            CHECK(a.efficiency > c.efficiency);
            CHECK(a.fairness > c.fairness);
            CHECK(a.stability > c.stability);
        }
    const auto a = mean_of(allostatic), c = mean_of(control), s = mean_of(cautious);
    for (const auto& [name, m] : {std::pair{"control", c}, {"allostatic", a}, {"cautious", s}})
        UNSCOPED_INFO(name << ": efficiency " << m.efficiency << ", fairness " << m.fairness << ", stability "
                           << m.stability << ", security " << m.security);
    CHECK(a.efficiency == Approx(0.742).margin(0.03));
    CHECK(a.fairness == Approx(0.43).margin(0.06));
    CHECK(a.stability == Approx(0.872).margin(0.025));
    CHECK(s.security > a.security + 0.01);
    CHECK(c.efficiency == Approx(0.455).margin(0.04));
}
