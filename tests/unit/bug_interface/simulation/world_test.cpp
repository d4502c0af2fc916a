#include "bug_interface/simulation/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/unit/bug_interface/world_diagnostics.h"

using namespace forage;
using namespace forage::bug;
using namespace forage::test;

namespace {

WorldOptions options(double cps = 25, std::uint64_t seed = 1, bool noise = true) {
    WorldOptions o;
    o.cycles_per_second = cps, o.seed = seed, o.noise = noise;
    return o;
}

/// A command that drives forward, with turns.
MotorCommand wander(std::uint64_t cycle) { return {0.8, std::sin(0.1 * static_cast<double>(cycle))}; }

bool same(const Pose2& a, const Pose2& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; }

/// The open arena with a robot in the centre whose heading is -y.
WorldDescription one_robot() {
    WorldDescription world = description("open_arena");
    test::find_model(world, "Bug")->pose = in_space({0, 0, -std::numbers::pi / 2});
    return world;
}

/// The same with a second robot.
WorldDescription two_robots(double x, double y, double yaw) {
    WorldDescription world = one_robot();
    Model other = *test::find_model(world, "Bug");
    other.name = "Second";
    other.pose = in_space({x, y, yaw});
    world.models.push_back(other);
    return world;
}

}  // namespace

TEST_CASE("A cycle has the number of substeps of its simulated time") {
    for (const auto& [cps, expected] : std::vector<std::pair<double, std::array<std::uint64_t, 3>>>{
             {25, {80, 80, 80}}, {60, {33, 33, 34}}, {50, {40, 40, 40}}}) {
        const auto world = make_world(description("basic_arena"), options(cps));
        CHECK(world->seconds_per_cycle() == Approx(2 / cps));
        for (int cycle = 0; cycle < 300; ++cycle) {
            const std::uint64_t before = world->substeps();
            world->advance_bodies();
            REQUIRE(world->substeps() - before == expected[static_cast<std::size_t>(cycle % 3)]);
        }
        CHECK(world->time() == Approx(300 * 2 / cps));
    }
    WorldOptions real_time = options(25);
    real_time.real_time_factor = 1;
    const auto world = make_world(description("basic_arena"), real_time);
    world->step();
    CHECK(world->substeps() == 40);
}

TEST_CASE("Without noise a robot drives straight, at the speed of its command") {
    const auto world = make_world(description("basic_arena"), options(25, 1, false));
    CHECK(world->robot_names() == std::vector<std::string>{"Bug"});
    CHECK(world->pose(0).y == -2);
    world->command(0, {1, 0});
    for (int i = 0; i < 50; ++i) world->step();
    CHECK(world->pose(0).y == Approx(2));
    CHECK(world->pose(0).x == Approx(0).margin(1e-4));
    CHECK(world->snapshot(0).pose.y == world->pose(0).y);
}

TEST_CASE("Driving noise spreads the heading by 2e-4 rad in 4.5 s, about the commanded course") {
    constexpr int runs = 400;
    double sum = 0, squares = 0, way = 0;
    for (int seed = 1; seed <= runs; ++seed) {
        const auto world =
            make_world(description("basic_arena"),
                       options(2.0 / 4.4, static_cast<std::uint64_t>(seed)));  // one cycle of 4.4 s
        world->command(0, {1, 0});
        world->advance_bodies();
        const double yaw = world->pose(0).yaw - 1.57079;
        sum += yaw, squares += yaw * yaw, way += (world->pose(0).y + 2) / runs;
    }
    const double expected = 0.005 / std::sqrt(3.0) * 0.001 * std::sqrt(4400.0);  // 1.9e-4
    CHECK(std::abs(sum / runs) < 4 * expected / std::sqrt(runs));
    CHECK(std::sqrt(squares / runs) == Approx(expected).epsilon(0.15));
    CHECK(way == Approx(4.4).epsilon(1e-5));
}

TEST_CASE("A robot that stands still moves slightly, unless noise is off") {
    const auto still = make_world(description("basic_arena"), options(25, 1, false)),
               trembling = make_world(description("basic_arena"));
    for (int i = 0; i < 10; ++i) still->step(), trembling->step();
    CHECK(same(still->pose(0), make_world(description("basic_arena"))->pose(0)));
    CHECK_FALSE(same(trembling->pose(0), still->pose(0)));
    CHECK(std::abs(trembling->pose(0).y + 2) < 1e-3);
}

TEST_CASE("Trials end at the bounds and the next one starts 1001 substeps later, at a start pose") {
    const auto world = make_world(description("basic_arena"), options(25));
    REQUIRE(world->targets().size() == 1);
    CHECK(world->targets()[0] == Eigen::Vector2d(0, 2.5));
    std::set<long> starts;
    for (int i = 0; i < 3000; ++i) {
        world->command(0, {1, 0});
        const bool before = world->resetting(0);
        world->step();
        if (world->resetting(0) && before) {  // observed at one of the start poses
            CHECK(std::abs(world->pose(0).y + 2) <= 0.01);
            const double x = world->pose(0).x;
            CHECK(std::abs(x - 1.5 * std::round(x / 1.5)) <= 0.01);
        }
    }
    const auto& trials = world->trials(0);
    REQUIRE(trials.size() > 40);
    CHECK(trials[0].number == 1);
    CHECK(trials[0].first_cycle == 0);
    CHECK(trials[0].cycles == 57);  // 4.5 m at 1 m/s are 4501 substeps
    CHECK(trials[0].start.x == 0);
    CHECK(trials[0].reached_target);
    for (std::size_t i = 1; i < trials.size(); ++i) {
        const Trial& t = trials[i];
        starts.insert(std::lround(t.start.x / 1.5));
        CHECK(t.number == static_cast<int>(i) + 1);
        CHECK(t.end.y > 2.5);
        CHECK(t.end.y < 2.502);
        const std::uint64_t pause = t.first_cycle - (trials[i - 1].first_cycle + trials[i - 1].cycles);
        CHECK((pause == 11 ||
               pause == 12));  // 1001 substeps of 80 to a cycle, less what the last cycle had left
        CHECK((t.cycles >= 57 && t.cycles <= 58));
        CHECK(t.smallest_distance == Approx(std::hypot(t.end.x, 0.0)).margin(0.002));
        CHECK(t.reached_target == (std::abs(t.end.x) < 0.45));
    }
    CHECK(starts == std::set<long>{-1, 0, 1});
    const Trial now = world->current_trial(0);
    CHECK(now.number == static_cast<int>(trials.size()) + 1);
}

TEST_CASE("A trial can be begun at any time, at a start pose or another one, also during a reset") {
    const auto world = make_world(description("basic_arena"), options(25, 1, false));
    const auto near_start = [&] {
        return std::ranges::any_of(world->start_poses(), [&](const Pose2& start) {
            return std::abs(start.x - world->pose(0).x) < 0.02 && std::abs(start.y - world->pose(0).y) < 0.02;
        });
    };
    world->begin_trial(0);  // nothing has happened: this is the first trial
    CHECK(world->trials(0).empty());
    CHECK(near_start());
    world->command(0, {1, 0});
    for (int i = 0; i < 5; ++i) world->step();
    world->begin_trial(0, Pose2{1, 1, 0.5});
    CHECK(same(world->pose(0), {1, 1, 0.5}));
    REQUIRE(world->trials(0).size() == 1);
    CHECK(world->trials(0)[0].cycles == 5);
    world->step();  // without a command
    CHECK(same(world->pose(0), {1, 1, 0.5}));
    CHECK(world->snapshot(0).pose.x == 1);
    world->command(0, {1, 0});
    while (!world->resetting(0)) world->step();
    REQUIRE(world->trials(0).size() == 2);
    world->begin_trial(0);
    CHECK(!world->resetting(0));
    CHECK(near_start());
    CHECK(world->trials(0).size() == 2);
    CHECK(world->current_trial(0).number == 3);
    CHECK(world->current_trial(0).first_cycle == world->cycle());
    for (int i = 0; i < 100; ++i) world->step();
    CHECK(near_start());

    const auto open = make_world(one_robot(), options(25, 1, false));  // without start poses
    const Pose2 first = open->pose(0);
    open->command(0, {1, 0});
    open->step();
    CHECK(!same(open->pose(0), first));
    open->begin_trial(0);
    CHECK(same(open->pose(0), first));
}

TEST_CASE("The same seed gives the same bits, another seed gives others, and images have no effect") {
    const auto a = make_world(description("basic_arena"), options(25, 7)),
               b = make_world(description("basic_arena"), options(25, 7)),
               other = make_world(description("basic_arena"), options(25, 8));
    b->request_image(0, true);
    bool differs = false;
    for (std::uint64_t i = 0; i < 300; ++i) {
        for (const auto& w : {a.get(), b.get(), other.get()}) w->command(0, wander(i)), w->step();
        REQUIRE(same(a->pose(0), b->pose(0)));
        REQUIRE(a->snapshot(0).proximity == b->snapshot(0).proximity);
        REQUIRE(a->snapshot(0).target == b->snapshot(0).target);
        differs |= !same(a->pose(0), other->pose(0)) && a->snapshot(0).target != other->snapshot(0).target;
    }
    CHECK(differs);
    const auto late = a->image(0), all_along = b->image(0);
    CHECK(std::equal(late.begin(), late.end(), all_along.begin(), all_along.end()));
    CHECK(a->trials(0).size() >= 1);
}

TEST_CASE("The noise of a robot does not depend on other robots") {
    const auto alone = make_world(one_robot()), together = make_world(two_robots(3, 3, 0));
    for (std::uint64_t i = 0; i < 20; ++i) {
        for (const auto& w : {alone.get(), together.get()}) w->command(0, wander(i)), w->step();
        REQUIRE(same(alone->pose(0), together->pose(0)));
    }
    CHECK_FALSE(same(together->pose(1), Pose2{3, 3, 0}));
}

TEST_CASE("Robots sense and stop each other") {
    const auto world = make_world(two_robots(0, -1.5, std::numbers::pi / 2), options(25, 1, false));
    CHECK(world->find("Second") == std::size_t{1});
    CHECK_FALSE(world->find("Third"));
    // The first robot looks down the y axis, the second one is ahead; rays 15 and 16 are 0.0968 rad beside
    // the axis.
    const auto reading = [](double apart) {
        return (2 -
                (apart * std::cos(0.096774) - std::sqrt(0.04 - std::pow(apart * std::sin(0.096774), 2)))) /
               2;
    };
    CHECK(world->snapshot(0).proximity[15] == Approx(reading(1.5)).margin(1e-4));
    CHECK(world->snapshot(0).proximity[16] == Approx(reading(1.5)).margin(1e-4));
    CHECK(world->snapshot(0).proximity[0] == 0);
    world->command(0, {1, 0});
    for (int i = 0; i < 10; ++i) world->step();
    CHECK(world->snapshot(0).proximity[15] == Approx(reading(0.7)).margin(1e-3));
    for (int i = 0; i < 20; ++i) world->step();
    CHECK(world->pose(0).y - world->pose(1).y == Approx(0.4).margin(0.001));
    CHECK(world->snapshot(0).proximity[15] == Approx(world->snapshot(1).proximity[15]));
}

TEST_CASE("The walls of the open arena stop a robot, and there are no trials") {
    const auto world = make_world(description("open_arena"));
    CHECK(world->targets().size() == 2);
    CHECK_FALSE(world->reset_plan());
    for (std::uint64_t i = 0; i < 500; ++i) {
        world->command(0, wander(i));
        world->step();
        REQUIRE(std::abs(world->pose(0).x) <= 6 - 0.3 + 1e-4);
        REQUIRE(std::abs(world->pose(0).y) <= 4 - 0.3 + 1e-4);
    }
    CHECK(world->trials(0).empty());
    CHECK(world->current_trial(0).cycles == 500);
    CHECK(world->physics().contact_steps() > 0);
}

TEST_CASE("The camera sees the floor in front of the robot") {
    WorldDescription arena = description("basic_arena");
    test::find_model(arena, "Bug")->pose = in_space({0, 0.615, std::numbers::pi / 2});
    const auto world = make_world(arena);
    REQUIRE(world->snapshot(0).image_width == 32);
    REQUIRE(world->snapshot(0).image_height == 28);
    const auto image = world->image(0);
    REQUIRE(image.size() == 32u * 28 * 3);
    int yellow = 0;
    for (std::size_t i = 0; i < image.size(); i += 3)
        yellow += image[i] > 200 && image[i + 1] > 200 && image[i + 2] < 50;
    CHECK(yellow == Approx(824).margin(30));
}

TEST_CASE("The drawing has floors, walls and colours") {
    const auto world = make_world(description("basic_arena"));
    REQUIRE(world->scene()->floors().size() == 1);
    CHECK(world->scene()->floors()[0].size_x == 8);
    const auto drawing = world->drawing();
    CHECK(drawing.size() == 5);  // wall, target, three start discs; not the robot
}

TEST_CASE("A world that cannot be simulated gives an error") {
    Diagnostics diagnostics;
    CHECK_FALSE(World::make(description("basic_arena"), options(0), diagnostics));
    CHECK(diagnostics.errors() == 1);
    WorldDescription twins = description("open_arena");
    twins.models.push_back(*test::find_model(twins, "Bug"));
    Diagnostics second;
    CHECK_FALSE(World::make(twins, {}, second));
    REQUIRE(second.errors() == 1);
    CHECK(second.all()[0].message == "there are two robots named 'Bug'");
    WorldDescription boxy = description("open_arena");
    for (auto& link : test::find_model(boxy, "Bug")->links) link.collisions.clear();
    Diagnostics third;
    CHECK_FALSE(World::make(boxy, {}, third));
    CHECK(third.errors() == 1);
}

TEST_CASE("The description of a world has the robots, poses and times") {
    CHECK(describe(*make_world(description("basic_arena"), options())) ==
          "basic_arena.world\n"
          "  robot       Bug at (0, -2) heading 1.571\n"
          "  start       Reset_0 at (-1.5, -2) heading 1.571\n"
          "  start       Reset_1 at (0, -2) heading 1.571\n"
          "  start       Reset_2 at (1.5, -2) heading 1.571\n"
          "  target      (0, 2.5)\n"
          "  bounds      x -2.5 to 2.5, y -2.5 to 2.5\n"
          "  trials      a robot that leaves the bounds is reset to a start pose\n"
          "  time        0.08 s of simulated time per cycle\n"
          "  in m and rad; heading 0 is along x, 1.571 along y\n");
    const std::string open = describe(*make_world(description("open_arena"), options(60)));
    CHECK(open.find("none: there are no start poses") != std::string::npos);
    CHECK(open.find("0.033 s of simulated time") != std::string::npos);
}
