// Several robots in a world: communication, sensor rates, latency and the game.
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;
using test::description;
using test::make_world;

namespace {

/// The open arena with robots R0, R1, ... at `places` instead of its own robot.
WorldDescription crowd(const std::vector<Pose2>& places) {
    WorldDescription world = description("open_arena");
    const Model robot = *test::find_model(world, "Bug");
    std::erase_if(world.models, [](const Model& m) { return m.name == "Bug"; });
    for (std::size_t i = 0; i < places.size(); ++i) {
        world.models.push_back(robot);
        world.models.back().name = "R" + std::to_string(i);
        world.models.back().pose = in_space(places[i]);
    }
    return world;
}

/// The team arena with a single robot, which has a gripper, and without a game.
WorldDescription alone() {
    WorldDescription world = description("team_arena");
    world.game.reset();
    std::erase_if(world.models, [](const Model& m) { return m.name.starts_with("B_") || m.name == "A_2"; });
    test::find_model(world, "A_1")->pose = in_space({0, 0, 0});
    return world;
}

Link& body_link(WorldDescription& world) {
    auto& links = test::find_model(world, "A_1")->links;
    return *std::find_if(links.begin(), links.end(), [](const Link& l) { return l.name == "bug"; });
}

std::vector<double> sound(double level) {
    std::vector<double> out(36, 0);
    out[3] = level;
    return out;
}

}  // namespace

TEST_CASE("A message is received in the next cycle, attenuated with distance, by robots with the same key") {
    WorldOptions options;
    options.noise = false;
    const auto world = make_world(crowd({{0, 0, 0}, {2, 0, 0}, {-3, 1, 0}, {0, -3, 0}}), options);
    const std::vector<double> nothing(36, 0);
    world->transmit(0, "blue", sound(0.8));
    world->transmit(1, "blue", nothing), world->transmit(2, "blue", nothing),
        world->transmit(3, "red", nothing);
    CHECK(world->snapshot(1).received[3] == 0);
    world->step();
    const double reach = 10 * std::sqrt(2.0);
    CHECK(world->snapshot(0).received[3] == 0);  // not itself
    CHECK(world->snapshot(1).received[3] == Approx(0.8 * (reach - 2) / reach));
    CHECK(world->snapshot(2).received[3] == Approx(0.8 * (reach - std::hypot(3, 1)) / reach));
    CHECK(world->snapshot(3).received[3] == 0);  // another key
    world->transmit(0, "blue", nothing), world->transmit(1, "blue", sound(0.5)),
        world->transmit(2, "blue", sound(0.25));
    world->step();
    CHECK(world->snapshot(1).received[3] ==
          Approx(0.25 * (reach - std::hypot(5, 1)) / reach));  // a silent message is transmitted once
    CHECK(world->snapshot(0).received[3] ==
          Approx(0.5 * (reach - 2) / reach + 0.25 * (reach - std::hypot(3, 1)) / reach));
    world->step();  // no robot transmits, not even silence
    CHECK(world->snapshot(0).received[3] > 0.5);
}

TEST_CASE("Sensors with rates of their own keep their measurements until they are due") {
    WorldOptions options;
    options.sensor_rates = true, options.real_time_factor = 0.25;  // 10 ms of simulated time per cycle
    const auto world = make_world(crowd({{0, 0, 0}}), options);
    world->command(0, {1, 0});
    int changes = 0;
    double last = world->snapshot(0).pose.x;
    for (int cycle = 0; cycle < 200; ++cycle) {
        world->step();
        changes += world->snapshot(0).pose.x != last;
        last = world->snapshot(0).pose.x;
    }
    CHECK(changes == 50);  // 25 per second, in 2 s
    CHECK(world->pose(0).x == Approx(2).margin(0.01));
}

TEST_CASE("Each sensor has its own rate") {
    WorldDescription text = alone();
    Link& link = body_link(text);
    for (RangeSensor& s : link.range_sensors)
        s.rate = s.name == "laser" ? 20 : s.name == "laser_target" ? 50 : 10, s.noise = 0.01;
    link.cameras.front().rate = 5;
    WorldOptions options;
    options.sensor_rates = true, options.real_time_factor = 0.25;  // 10 ms of simulated time per cycle
    const auto world = make_world(text, options);
    const auto robot = world->find("A_1").value();
    world->request_gripper_scan(robot, true), world->request_image(robot, true);
    world->command(robot, {0.5, 1});
    int poses = 0, proximity = 0, target = 0, gripper = 0, pictures = 0;
    BugSnapshot last = world->snapshot(robot);
    for (int cycle = 0; cycle < 200; ++cycle) {  // 2 s
        world->step();
        const BugSnapshot& now = world->snapshot(robot);
        poses += now.pose.x != last.pose.x;
        proximity += now.proximity != last.proximity, target += now.target != last.target;
        gripper += now.gripper != last.gripper, pictures += now.image != last.image;
        CHECK((now.pose.x != last.pose.x) ==
              (now.proximity != last.proximity));  // the GPS has the rate of the proximity sensor
        last = now;
    }
    CHECK(poses == 40);
    CHECK(proximity == 40);
    CHECK(target == 100);
    CHECK(gripper == 20);
    CHECK(pictures == 10);
}

TEST_CASE(
    "Observers see the current image of a camera, also without a module, at a low rate, and with a latency") {
    WorldDescription text = alone();
    body_link(text).cameras.front().rate = 0.1;
    WorldOptions options, slow;
    slow.sensor_rates = true, slow.latency = 5;
    options.noise = slow.noise = false;  // with rates, noise is drawn for other steps
    for (const bool read_by_module : {false, true}) {
        const auto a = make_world(text, options), b = make_world(text, slow);
        const auto robot = a->find("A_1").value();
        if (read_by_module) b->request_image(robot, true);
        for (int cycle = 0; cycle < 20; ++cycle) {
            for (World* w : {a.get(), b.get()}) w->command(robot, {0.5, 1}), w->step();
            const auto prompt = a->image(robot), seen = b->image(robot);
            REQUIRE(!prompt.empty());
            REQUIRE(std::equal(prompt.begin(), prompt.end(), seen.begin(), seen.end()));
        }
        if (read_by_module) CHECK(b->snapshot(robot).image != a->snapshot(robot).image);
    }
}

TEST_CASE("Snapshots can have a latency of several cycles") {
    WorldOptions prompt, delayed;
    delayed.latency = 3;
    const auto a = make_world(crowd({{0, 0, 0}}), prompt), b = make_world(crowd({{0, 0, 0}}), delayed);
    a->command(0, {1, 0.3}), b->command(0, {1, 0.3});
    a->request_image(0, true), b->request_image(0, true);
    std::vector<BugSnapshot> seen{a->snapshot(0)};
    for (int cycle = 1; cycle < 30; ++cycle) {
        a->step(), b->step();
        seen.push_back(a->snapshot(0));
        const BugSnapshot& then = seen[static_cast<std::size_t>(std::max(0, cycle - 3))];
        REQUIRE(b->snapshot(0).pose.x == then.pose.x);
        REQUIRE(b->snapshot(0).proximity == then.proximity);
        REQUIRE(b->snapshot(0).image == then.image);
    }
}

TEST_CASE("A resource ages, turns yellow and dissolves") {
    WorldDescription text = description("team_arena");
    text.game->sites = {{-1, 1, 1}};  // one per second
    text.game->stale_after = 3, text.game->dissolves_after = 5, text.game->most = 4;
    std::erase_if(text.models, [](const Model& m) { return m.name.starts_with("B_") || m.name == "A_2"; });
    test::find_model(text, "A_1")->pose = in_space({3, -1, 3 * std::numbers::pi / 4});
    const auto world = make_world(text);
    const auto present = [&] {
        std::size_t n = 0;
        for (std::size_t i = 0; i < world->movable_objects(); ++i)
            n += world->movable_object_pose(i).has_value();
        return n;
    };
    CHECK(present() == 0);
    for (int cycle = 0; cycle < 27; ++cycle) world->step();
    CHECK(present() == 1);
    const auto first = world->movable_object_pose(0);
    CHECK(std::hypot(first->x + 1, first->y - 1) <= 0.5);
    const auto is_yellow = [&](std::size_t thing) {
        for (const MovingVisual& s : world->moving_visuals())
            if (s.body == world->bugs() + thing) return s.visual.material.diffuse[0] == 1;
        return false;
    };
    CHECK_FALSE(is_yellow(0));
    for (int cycle = 0; cycle < 75; ++cycle) world->step();
    CHECK(is_yellow(0));
    for (int cycle = 0; cycle < 60; ++cycle) world->step();
    CHECK(world->game().resources()[0].age < 5);  // it was removed, or is removed
    CHECK(present() >= 3);
    CHECK(world->game().deliveries().empty());
}

TEST_CASE("A resource that a robot pushes into a home counts for that team and is removed") {
    WorldDescription text = description("team_arena");
    text.game->sites = {{-1, 1, 0.2}};
    std::erase_if(text.models, [](const Model& m) { return m.name.starts_with("B_") || m.name == "A_2"; });
    test::find_model(text, "A_1")->pose = in_space({1, -1, 3 * std::numbers::pi / 4});
    const auto world = make_world(text);
    for (int cycle = 0; cycle < 300; ++cycle) world->step();
    world->command(0, {1, 0});
    for (int cycle = 0; cycle < 200; ++cycle) world->step();
    const auto& deliveries = world->game().deliveries();
    REQUIRE_FALSE(deliveries.empty());
    int sum = 0;
    for (const auto& d : deliveries) {
        CHECK(d.team == 0);
        CHECK(d.points == (d.good ? 2 : -1));
        sum += d.points;
    }
    CHECK(world->game().points(0) == sum);
    CHECK(world->game().points(1) == 0);
}
