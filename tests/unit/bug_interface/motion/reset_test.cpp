#include "bug_interface/motion/reset.h"

#include <algorithm>
#include <cmath>

#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;
using Phase = Reset::Phase;

namespace {

ResetPlan plan_of(const WorldDescription& world) {
    Diagnostics diagnostics;
    const auto plan = find_reset(world, diagnostics);
    REQUIRE(plan);
    return *plan;
}

std::string problem_of(const WorldDescription& world) {
    Diagnostics diagnostics;
    find_reset(world, diagnostics);
    REQUIRE(diagnostics.errors() == 1);
    return diagnostics.all().front().message;
}

}  // namespace

TEST_CASE("The basic arena resets at 2.5 m to one of three start poses") {
    const ResetPlan plan = plan_of(test::description("basic_arena"));
    CHECK(plan.bounds.min() == Eigen::Vector2d(-2.5, -2.5));
    CHECK(plan.bounds.max() == Eigen::Vector2d(2.5, 2.5));
    REQUIRE(plan.starts.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(plan.starts[i].x == -1.5 + 1.5 * static_cast<double>(i));
        CHECK(plan.starts[i].y == -2);
        CHECK(plan.starts[i].yaw == Approx(1.57079));
    }
}

TEST_CASE("A world without Reset_i has no resets") {
    Diagnostics diagnostics;
    CHECK_FALSE(find_reset(test::description("open_arena"), diagnostics));
    CHECK(diagnostics.all().empty());
}

TEST_CASE("Start poses without bounds are an error, not an endless reset") {
    WorldDescription world = test::description("basic_arena");
    test::find_model(world, "GroundPlane")->name = "Floor";
    CHECK(problem_of(world) ==
          "there is a start pose 'Reset_0', but no model named GroundPlane that gives the bounds");
    world = test::description("basic_arena");
    test::find_model(world, "GroundPlane")->links.back().collisions.clear();
    CHECK(problem_of(world) == "the last link of GroundPlane has no collision that gives the bounds");
    world = test::description("basic_arena");
    test::find_model(world, "Reset_1")->pose.translation().y() = -2.6;
    CHECK(problem_of(world) ==
          "'Reset_1' at (0, -2.6) is not inside the bounds x -2.5 to 2.5, y -2.5 to 2.5");
}

TEST_CASE("The last collision of the last link gives the bounds, at any pose") {
    WorldDescription world = test::description("basic_arena");
    Model& ground = *test::find_model(world, "GroundPlane");
    ground.pose.translation() = Eigen::Vector3d(1, 2, 0);
    ground.links.back().collisions.back().shape.size = {8, 10, 1};
    CHECK(plan_of(world).bounds.min() == Eigen::Vector2d(-3, -3));
    CHECK(plan_of(world).bounds.max() == Eigen::Vector2d(5, 7));
}

TEST_CASE("A plane does not give bounds, as trials would never end") {
    WorldDescription world = test::description("basic_arena");
    Model& ground = *test::find_model(world, "GroundPlane");
    std::swap(ground.links.back().collisions.front(), ground.links.back().collisions.back());
    REQUIRE(ground.links.back().collisions.back().shape.kind == ShapeKind::plane);
    CHECK(problem_of(world) == "GroundPlane's last collision is a plane, so the arena has no bounds");
}

TEST_CASE("Names of start poses that are not used give warnings") {
    const auto warning = [](const char* from, const char* to) {
        WorldDescription world = test::description("basic_arena");
        test::find_model(world, from)->name = to;
        Diagnostics diagnostics;
        const auto plan = find_reset(world, diagnostics);
        CHECK((plan && plan->starts.size() == 2 && plan->names.size() == 2));
        REQUIRE(diagnostics.all().size() == 1);
        CHECK(diagnostics.errors() == 0);
        return diagnostics.all().front().message;
    };
    CHECK(warning("Reset_2", "Reset_0") == "there are two models named 'Reset_0'; the first one is used");
    for (const char* name : {"Reset_10", "Reset_A", "Reset_"})
        CHECK(warning("Reset_2", name) ==
              "'" + std::string(name) + "' is not a start pose: only Reset_0 to Reset_9 are");
}

TEST_CASE("A reset takes 1001 substeps, and its bounds are strict") {
    const ResetPlan plan = plan_of(test::description("basic_arena"));
    Reset reset(plan, RandomStream(1, "reset"));
    for (const Pose2 inside : {Pose2{0, 2.5, 0}, Pose2{0, -2.5, 0}, Pose2{2.5, 0, 0}, Pose2{-2.5, 0, 0}})
        CHECK(reset.substep(inside) == Phase::none);
    for (const Pose2 outside :
         {Pose2{0, 2.501, 0}, Pose2{0, -2.501, 0}, Pose2{2.501, 0, 0}, Pose2{-2.501, 0, 0}}) {
        int substeps = 1;
        CHECK(reset.substep(outside) == Phase::begin);
        CHECK(reset.running());
        while (reset.substep(outside) == Phase::hold) ++substeps;
        CHECK(++substeps == 1001);
        CHECK_FALSE(reset.running());
    }
}

TEST_CASE("Start poses are drawn evenly, with deviations up to 0.01 m and 0.01 rad") {
    Reset reset(plan_of(test::description("basic_arena")), RandomStream(1, "reset"));
    constexpr int n = 30000;
    std::array<int, 3> drawn{};
    Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = sum, farthest = sum;
    for (int i = 0; i < n; ++i) {
        const Pose2 p = reset.start_pose();
        const auto which = static_cast<int>(std::lround(p.x / 1.5)) + 1;
        ++drawn[static_cast<std::size_t>(which)];
        const Eigen::Array3d off(p.x - 1.5 * (which - 1), p.y + 2, p.yaw - 1.57079);
        sum += off, squares += off * off, farthest = farthest.max(off.abs());
    }
    for (const int d : drawn) CHECK(std::abs(d - n / 3) < 350);  // 4 standard deviations
    CHECK((sum / n).abs().maxCoeff() < 2e-4);
    CHECK(((squares / n).sqrt() - 0.01 / std::sqrt(3.0)).abs().maxCoeff() < 1e-4);
    CHECK(farthest.maxCoeff() <= 0.01 + 1e-12);
    CHECK(farthest.minCoeff() > 0.0099);
}

namespace {

/// The basic arena, whose trials end at the target (2.5 m north, with a reach of 0.8 m) or after 6 s.
WorldDescription with_rules() {
    WorldDescription world = test::description("basic_arena");
    world.trials.emplace();
    world.trials->reach = 0.8;
    world.trials->duration = 6;
    return world;
}

}  // namespace

TEST_CASE("With rules, a trial ends at a target, and only one cycle reports it") {
    const auto world = test::make_world(with_rules());
    world->command(0, {1, 0});  // straight on, from (0, -2)
    int reported = 0;
    while (world->trials(0).empty()) {
        world->step();
        reported += world->just_reached(0);
    }
    const Trial& trial = world->trials(0).front();
    CHECK(trial.reached_target);
    CHECK(trial.end.y == Approx(1.7).margin(0.01));
    CHECK(world->resetting(0));
    for (int i = 0; i < 10; ++i) {
        world->step();
        reported += world->just_reached(0);
    }
    CHECK(reported == 1);
}

TEST_CASE("With rules, a trial ends after a time") {
    const auto world = test::make_world(with_rules());
    while (world->trials(0).empty()) world->step();
    const Trial& trial = world->trials(0).front();
    CHECK_FALSE(trial.reached_target);
    CHECK_FALSE(world->just_reached(0));
    CHECK(static_cast<double>(trial.cycles) * world->seconds_per_cycle() == Approx(6).margin(0.1));
    while (world->resetting(0)) world->step();
    CHECK(world->current_trial(0).cycles <= 1);
}

TEST_CASE("Rules say how much the headings of the starts differ") {
    WorldDescription description = with_rules();
    description.trials->heading = 3;
    Diagnostics diagnostics;
    const auto plan = find_reset(description, diagnostics);
    REQUIRE(plan);
    Reset reset(*plan, RandomStream(1, "r"));
    double low = 10, high = -10;
    for (int i = 0; i < 500; ++i) {
        const double off = reset.start_pose().yaw - 1.57079;
        low = std::min(low, off), high = std::max(high, off);
    }
    CHECK(low == Approx(-3).margin(0.05));
    CHECK(high == Approx(3).margin(0.05));
}

TEST_CASE("Rules of trials without start poses are a warning") {
    WorldDescription world = test::description("open_arena");
    world.trials.emplace();
    Diagnostics diagnostics;
    CHECK_FALSE(find_reset(world, diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all().front().message == "there are rules of trials, but no start poses, so no trials");
}
