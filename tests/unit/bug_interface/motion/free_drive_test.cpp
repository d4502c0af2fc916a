#include "bug_interface/motion/free_drive.h"

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "tests/support/catch.h"
#include "tests/unit/bug_interface/physics_step.h"

using namespace forage;
using namespace forage::bug;
using test::physics_step_s;

namespace {

/// The reference, substep by substep: the velocity plugin, then the motion.
Pose2 stepped(Pose2 at, const MotorCommand& command, std::uint64_t steps, const RandomStream* random,
              std::uint64_t first) {
    for (std::uint64_t k = 0; k < steps; ++k) {
        std::array<double, 2> u = {0.5, 0.5};
        if (random) random->uniform(first + k, u);
        const double forward = command.forward + (2 * u[0] - 1) * speed_noise,
                     turn = command.turn + (2 * u[1] - 1) * speed_noise;
        at = {at.x + forward * std::cos(at.yaw) * physics_step_s,
              at.y + forward * std::sin(at.yaw) * physics_step_s, at.yaw + turn * physics_step_s};
    }
    return at;
}

}  // namespace

TEST_CASE("Free driving without noise ends where the substeps end") {
    const RandomStream random(1, "robot");
    const double forward = GENERATE(0.0, 0.5, 1.0, -0.25), turn = GENERATE(0.0, 1e-12, 0.3, -1.0, 6.0);
    const std::uint64_t steps = GENERATE(1, 33, 80);
    const Pose2 from{1, -2, 1.57079};
    const Pose2 free = free_drive(from, {forward, turn}, steps, physics_step_s, 0, random, 7),
                walked = stepped(from, {forward, turn}, steps, nullptr, 0);
    CHECK(free.x == Approx(walked.x).margin(1e-13));
    CHECK(free.y == Approx(walked.y).margin(1e-13));
    CHECK(free.yaw == Approx(walked.yaw).margin(1e-13));
}

TEST_CASE("Free driving with noise has the means, deviations and correlations of the substeps") {
    const RandomStream random(2, "robot"), other(3, "robot");
    const double forward = GENERATE(0.0, 1.0), turn = GENERATE(0.0, 1.5);
    const std::uint64_t steps = GENERATE(33, 80);
    const Pose2 from{0, 0, 0.3};
    constexpr Eigen::Index samples = 40'000;
    // Means, deviations and correlations of the displacements along and across the middle heading, and of the
    // heading.
    const double middle = from.yaw + turn * physics_step_s * static_cast<double>(steps - 1) / 2;
    const auto measure = [&](auto drive) {
        Eigen::ArrayX3d all(samples, 3);
        for (Eigen::Index i = 0; i < samples; ++i) {
            const Pose2 at = drive(static_cast<std::uint64_t>(i));
            all.row(i) << at.x * std::cos(middle) + at.y * std::sin(middle),
                at.y * std::cos(middle) - at.x * std::sin(middle), at.yaw;
        }
        return all;
    };
    const Eigen::ArrayX3d free = measure([&](std::uint64_t i) {
        return free_drive(from, {forward, turn}, steps, physics_step_s, speed_noise, random, i);
    });
    const Eigen::ArrayX3d walked = measure([&](std::uint64_t i) {
        return stepped(from, {forward, turn}, steps, &other, i * steps);
    });
    const auto centred = [](const Eigen::ArrayX3d& a) -> Eigen::ArrayX3d {
        return a.rowwise() - a.colwise().mean();
    };
    const Eigen::ArrayX3d f = centred(free), w = centred(walked);
    for (int i = 0; i < 3; ++i) {
        const double spread = std::sqrt(w.col(i).square().mean());
        INFO("number " << i << ", deviation " << spread);
        if (spread < 1e-8) {  // of second order: a robot that stands still does not move sideways
            CHECK(std::sqrt(f.col(i).square().mean()) < 1e-8);
            continue;
        }
        CHECK(free.col(i).mean() ==
              Approx(walked.col(i).mean()).margin(4 * spread * std::sqrt(2.0 / samples)));
        CHECK(std::sqrt(f.col(i).square().mean()) == Approx(spread).epsilon(0.02));
        // Fourth moments: sums of many uniform numbers are normal except for 1.2 / steps.
        const double kurtosis = w.col(i).pow(4).mean() / std::pow(spread, 4);
        CHECK(f.col(i).pow(4).mean() / std::pow(f.col(i).square().mean(), 2) ==
              Approx(kurtosis).margin(0.12));
        for (int k = 0; k < i; ++k) {
            if (std::sqrt(w.col(k).square().mean()) < 1e-8) continue;
            const auto correlation = [&](const Eigen::ArrayX3d& a) {
                return (a.col(i) * a.col(k)).mean() /
                       std::sqrt(a.col(i).square().mean() * a.col(k).square().mean());
            };
            INFO("and number " << k);
            CHECK(correlation(f) == Approx(correlation(w)).margin(4 * std::sqrt(2.0 / samples)));
        }
    }
}
