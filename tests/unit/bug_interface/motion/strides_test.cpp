// Strides are compared with steps of 1 ms: what slides, pushes and holds must move in the same way.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "core/base/random.h"
#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;
using std::numbers::pi;
using test::apart;
using test::description;
using test::make_world;

namespace {

/// One of the models of the team arena with another name and pose.
Model copy_of(const WorldDescription& world, const std::string& name, const std::string& as,
              const Pose2& pose) {
    const auto found = std::find_if(world.models.begin(), world.models.end(),
                                    [&](const Model& m) { return m.name == name; });
    Model out = *found;
    out.name = as, out.pose = in_space(pose);
    return out;
}

Model ball_model(const std::string& name, double x, double y) {
    Model model;
    model.name = name;
    Link link;
    link.name = "body", link.mass = 0.01, link.pose.translation().z() = 0.06;
    link.collisions.push_back(
        {{}, "c", Pose::Identity(), {ShapeKind::sphere, Eigen::Vector3d::Constant(0.16)}, 0.1});
    model.links.push_back(link);
    model.pose.translation() = Eigen::Vector3d(x, y, 0);
    return model;
}

/// A world in strides and in single steps, with the same random numbers.
struct Both {
    std::unique_ptr<World> strides, steps;
    Both(const WorldDescription& text, std::uint64_t seed) {
        WorldOptions options;
        options.seed = seed;
        strides = make_world(text, options);
        options.stepping = Physics::Stepping::single;
        steps = make_world(text, options);
    }
    void command(std::size_t bug, const MotorCommand& c) { strides->command(bug, c), steps->command(bug, c); }
    void grip(std::size_t bug, bool close) { strides->grip(bug, close), steps->grip(bug, close); }
    void step() { strides->step(), steps->step(); }
};

/// The value that a share `q` of the values is below.
double quantile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

/// The largest distance of the distribution functions of two samples (Kolmogorov and Smirnov), in units of
/// its scale under equality: above 1.63 with a chance of 1 %.
double difference(std::vector<double> a, std::vector<double> b) {
    std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
    double most = 0;
    for (const double v : a) {
        const auto share = [v](const std::vector<double>& of) {
            return static_cast<double>(std::upper_bound(of.begin(), of.end(), v) - of.begin()) /
                   static_cast<double>(of.size());
        };
        most = std::max(most, std::abs(share(a) - share(b)));
    }
    const double n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
    return most * std::sqrt(n * m / (n + m));
}

}  // namespace

TEST_CASE("A robot slides along walls and into corners as in steps of 1 ms") {
    const WorldDescription text = description("open_arena");
    const RandomStream random(5, "slides");
    std::vector<double> errors, turns, ways[2];
    for (std::uint64_t run = 0; run < 60; ++run) {
        WorldDescription world = text;
        for (Model& m : world.models)
            if (m.name == "Bug")
                m.pose = in_space({4 * random.uniform(run, 0) - 2, 4 * random.uniform(run, 1) - 2,
                                   2 * pi * random.uniform(run, 2)});
        Both both(world, run);
        both.command(0, {0.4 + 0.6 * random.uniform(run, 3), random.uniform(run, 4) - 0.5});
        Pose2 at[2] = {both.strides->pose(0), both.steps->pose(0)};
        double way[2] = {};
        for (int cycle = 0; cycle < 75; ++cycle) {
            both.step();
            const Pose2 now[2] = {both.strides->pose(0), both.steps->pose(0)};
            for (int k = 0; k < 2; ++k) way[k] += apart(at[k], now[k]), at[k] = now[k];
        }
        errors.push_back(apart(at[0], at[1]));
        turns.push_back(std::abs(std::remainder(at[0].yaw - at[1].yaw, 2 * pi)));
        for (int k = 0; k < 2; ++k) ways[k].push_back(way[k]);
    }
    INFO("ends differ by " << quantile(errors, 0.5) << ", " << quantile(errors, 0.9) << ", "
                           << quantile(errors, 1) << " m, headings by " << quantile(turns, 0.5) << ", "
                           << quantile(turns, 1) << " rad");
    CHECK(quantile(errors, 0.5) < 0.002);
    CHECK(quantile(errors, 0.9) < 0.01);
    CHECK(quantile(turns, 0.9) < 0.01);
    CHECK(difference(ways[0], ways[1]) < 1.63);
}

TEST_CASE("A crowd of robots with grippers and balls moves as in steps of 1 ms", "[long]") {
    WorldDescription text = description("team_arena");
    text.game.reset();
    const RandomStream random(6, "crowd");
    std::vector<double> ways[2], carried[2], ends[2];
    for (std::uint64_t run = 0; run < 24; ++run) {
        WorldDescription world = text;
        std::erase_if(world.models,
                      [](const Model& m) { return m.name.starts_with("A_") || m.name.starts_with("B_"); });
        for (int i = 0; i < 4; ++i) {
            const double angle = pi / 2 * i;
            world.models.push_back(copy_of(text, "A_1", fmt::format("R{}", i),
                                           {1.3 * std::cos(angle), 1.3 * std::sin(angle), angle + pi}));
            world.models.push_back(
                ball_model(fmt::format("Ball{}", i), 0.9 * std::cos(angle), 0.9 * std::sin(angle)));
        }
        Both both(world, run);
        Pose2 at[2][8];
        const auto pose = [&](World& w, std::size_t i) {
            return i < 4 ? w.pose(i) : w.movable_object_pose(i - 4).value();
        };
        double way[2][8] = {};
        for (std::size_t i = 0; i < 8; ++i)
            at[0][i] = pose(*both.strides, i), at[1][i] = pose(*both.steps, i);
        for (std::uint64_t cycle = 0; cycle < 250; ++cycle) {
            for (std::uint32_t i = 0; i < 4; ++i) {
                const std::uint64_t draw = 100 * run + cycle / 25;
                both.command(
                    i, {1.2 * random.uniform(draw, 3 * i) - 0.2, 3 * random.uniform(draw, 3 * i + 1) - 1.5});
                both.grip(i, random.uniform(draw, 3 * i + 2) < 0.5);
            }
            both.step();
            for (std::size_t i = 0; i < 8; ++i) {
                const Pose2 now[2] = {pose(*both.strides, i), pose(*both.steps, i)};
                for (int k = 0; k < 2; ++k) way[k][i] += apart(at[k][i], now[k]), at[k][i] = now[k];
            }
        }
        for (int k = 0; k < 2; ++k)
            for (std::size_t i = 0; i < 8; ++i) {
                (i < 4 ? ways : carried)[k].push_back(way[k][i]);
                ends[k].push_back(std::hypot(at[k][i].x, at[k][i].y));
            }
    }
    INFO("ways " << quantile(ways[0], 0.5) << " and " << quantile(ways[1], 0.5) << " m, of balls "
                 << quantile(carried[0], 0.5) << " and " << quantile(carried[1], 0.5) << " m; differences "
                 << difference(ways[0], ways[1]) << ", " << difference(carried[0], carried[1]) << ", "
                 << difference(ends[0], ends[1]));
    CHECK(difference(ways[0], ways[1]) < 1.63);
    CHECK(difference(carried[0], carried[1]) < 1.63);
    CHECK(difference(ends[0], ends[1]) < 1.63);
}
