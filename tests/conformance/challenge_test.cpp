// The original's robots and arenas against their specification: bodies, sensors, grippers, homes, lights,
// lines.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
using namespace forage::bug;
using namespace forage::test;

namespace {

constexpr double pi = std::numbers::pi;

WorldDescription original(const std::string& name) {
    Diagnostics diagnostics;
    const auto world = read_world((shared_dir() / "original" / (name + ".world")).string(), diagnostics);
    INFO(format(diagnostics));
    REQUIRE(world);
    return *world;
}

std::unique_ptr<World> made(const WorldDescription& description, WorldOptions options = {}) {
    Diagnostics diagnostics;
    options.noise = false;
    auto world = World::make(description, options, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(world);
    return world;
}

/// The world with its first robot at another place.
std::unique_ptr<World> with_robot_at(const std::string& name, const Pose2& place) {
    WorldDescription text = original(name);
    const std::string robot = made(text)->robot_names().front();
    for (Model& m : text.models)
        if (m.name == robot) m.pose = in_space(place);
    return made(text);
}

const RangeSensor& sensor(const World& world, const std::string& name) {
    const auto& all = world.robot(0).sensors.range_sensors();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
    REQUIRE(found != all.end());
    return *found;
}

double strongest(const std::vector<double>& cells) { return *std::max_element(cells.begin(), cells.end()); }

/// Mean of a channel over the camera's picture, 0..255.
double mean(World& world, int channel) {
    const auto picture = world.image(0);
    REQUIRE(picture.size() == 32 * 28 * 3);
    double sum = 0;
    for (std::size_t i = static_cast<std::size_t>(channel); i < picture.size(); i += 3) sum += picture[i];
    return sum / (32 * 28);
}

}  // namespace

TEST_CASE("The robots' bodies, ray sensors and cameras are those of the specification") {
    if (absent(shared_dir() / "original")) return;
    for (const std::string name : {"DAC_files/DAC_arena", "SDIC_challenge/SDIC_one_robot_arena"}) {
        INFO(name);
        const bool dac = name.starts_with("DAC");
        const auto world = made(original(name));
        const Robot& robot = world->robot(0);
        CHECK((robot.body.radius == 0.2 && robot.body.mass == 5 && robot.body.inertia == 1));
        CHECK(robot.body.friction == 0.1);
        const auto height = [&](const RangeSensor& s) {
            return (robot.sensors.link_pose() * s.pose).translation().z();
        };
        const RangeSensor &near = sensor(*world, "laser"), &light = sensor(*world, "laser_target");
        CHECK((near.rays == 32 && near.first_angle == -3 && near.last_angle == 3));
        CHECK((near.min_range == (dac ? 0.205 : 0.201) && near.max_range == 2));
        CHECK((near.noise == 0.02 && near.rate == 25));
        CHECK(height(near) == Approx(0.175));
        CHECK((light.rays == 32 && light.first_angle == -3 && light.last_angle == 3));
        CHECK((light.min_range == 0.26 && light.max_range == 2.5 && light.noise == 0.02 && light.rate == 25));
        CHECK(height(light) == Approx(0.35));
        REQUIRE(robot.sensors.camera_sensor());
        const CameraSensor& camera = *robot.sensors.camera_sensor();
        CHECK((camera.width == 32 && camera.height == 28 && camera.noise == 0.001 && camera.rate == 30));
        CHECK(camera.horizontal_fov == (dac ? 0.8047 : 1.0047));
        CHECK((robot.sensors.link_pose() * camera.pose).translation().z() == Approx(0.35));
        const Pose2& at = world->pose(0);
        const Eigen::Vector2d seen = world->looks_at(0) - Eigen::Vector2d(at.x, at.y);
        CHECK(seen.norm() == Approx(dac ? 0.3781 : 0.671).margin(0.001));
        CHECK(world->has_gripper(0) == !dac);
        if (dac) continue;
        const RangeSensor& fingers = sensor(*world, "laser_gripper");
        CHECK((fingers.rays == 16 && fingers.first_angle == -1 && fingers.last_angle == 1));
        CHECK((fingers.min_range == 0.0155 && fingers.max_range == 0.2 && fingers.noise == 0.005));
        CHECK(fingers.rate == 25);
        CHECK(height(fingers) == Approx(0.08));
    }
}

TEST_CASE("The gripper's hinges have the positions, limits and speeds of the specification") {
    if (absent(shared_dir() / "original")) return;
    const auto world = made(original("SDIC_challenge/SDIC_one_robot_arena"));
    const Hinges& hinges = world->robot(0).hinges;
    int fingers = 0, tips = 0;
    for (std::size_t i = 0; i < hinges.size(); ++i) {
        const auto& h = hinges[i];
        INFO(h.name);
        CHECK(h.upper == Approx(h.upper == 0 ? 0 : 0.4));
        if (h.upper == 0) continue;  // the palm, welded with a hinge that cannot turn
        const bool tip = h.lower == 0;
        (tip ? tips : fingers) += 1;
        CHECK(h.lower == Approx(tip ? 0 : -0.2));
        CHECK(h.x == Approx(tip ? 0.288 : 0.167).margin(0.002));
        CHECK(std::abs(h.y) == Approx(tip ? 0.150 : 0.047).margin(0.002));
        CHECK((h.sense < 0) == (h.y > 0));                                    // positive angles close
        CHECK(3 / h.inertia * 0.001 == Approx(tip ? 3 : 1.5).epsilon(0.01));  // rad/s
    }
    CHECK((fingers == 2 && tips == 2));
}

TEST_CASE("Homes are where the walls of the challenge or of the competition show them") {
    if (absent(shared_dir() / "original")) return;
    WorldOptions game;
    game.game = true;
    for (const auto& [name, at] : std::map<std::string, double>{{"SDIC_arena", 10},
                                                                {"SDIC_one_robot_arena", 10},
                                                                {"SDIC_two_robot_arena", 10},
                                                                {"SDIC_competition", 15}}) {
        INFO(name);
        const auto world = made(original("SDIC_challenge/" + name), game);
        const auto& homes = world->game().homes();
        CHECK((homes[0].x == -at && homes[0].y == at && homes[1].x == at && homes[1].y == -at));
        CHECK(world->game().left() == 300);
        CHECK(world->movable_objects() == 16);
    }
}

TEST_CASE("The resources of the two-robot arena count at a home, also without a game") {
    if (absent(shared_dir() / "original")) return;
    WorldDescription text = original("SDIC_challenge/SDIC_two_robot_arena");
    for (Model& m : text.models)
        if (m.name == "target_3") m.pose = in_space({-8.5, 8.0, 0});
    const auto world = made(text);
    CHECK_FALSE(world->game().timed());
    for (int cycle = 0; cycle < 3; ++cycle) world->step();
    REQUIRE(world->game().deliveries().size() == 1);
    CHECK(world->game().deliveries().front().team == 0);
    CHECK(world->movable_object(0).name == "target_0");
    CHECK(world->movable_object_pose(0)->y == 3);  // the others lie in the open
}

TEST_CASE("Resources are blue balls that only the gripper's rays and the camera sense") {
    if (absent(shared_dir() / "original")) return;
    const auto world = with_robot_at("SDIC_challenge/SDIC_two_robot_arena", {-0.58, 3, 0});
    world->request_gripper_scan(0, true);
    world->scan();                                       // target_4 at (-0.2, 3), 0.38 m ahead
    for (std::size_t ahead = 10; ahead < 22; ++ahead) {  // the pillar stands to the right
        CHECK(world->snapshot(0).proximity[ahead] == 0);
        CHECK(world->snapshot(0).target[ahead] == 0);
    }
    CHECK(world->snapshot(0).gripper[7] == Approx((0.2 - (0.38 - 0.19 - 0.077)) / 0.2).margin(0.05));
    const auto picture = world->image(0);
    int blue = 0;
    for (std::size_t i = 0; i < picture.size(); i += 3)
        blue += picture[i] < 30 && picture[i + 1] < 30 && picture[i + 2] > 60;
    CHECK(blue > 10);
}

TEST_CASE("Solids of 0.5 m height count as light: the pillar, and the walls of the tutorial's arenas") {
    if (absent(shared_dir() / "original")) return;
    const auto seen = [](const std::string& name, const Pose2& place) {
        const auto world = with_robot_at(name, place);
        return std::pair(strongest(world->snapshot(0).proximity), strongest(world->snapshot(0).target));
    };
    const double off = 3.0 / 31;  // of the rays nearest to straight ahead, rad
    // The pillar of radius 1 m in the middle, 1 m away; Obstacle_5 of radius 0.75 m, 0.25 m high, too.
    const auto [near, light] = seen("SDIC_challenge/SDIC_one_robot_arena", {-2, 0, 0});
    const double to_pillar = 2 * std::cos(off) - std::sqrt(1 - std::pow(2 * std::sin(off), 2));
    CHECK(near == Approx((2 - to_pillar) / 2).margin(1e-6));
    CHECK(light == Approx((2.5 - to_pillar) / 2.5).margin(1e-6));
    const auto [low, none] = seen("SDIC_challenge/SDIC_one_robot_arena", {4.25, 1, 0});
    CHECK((low > 0.4 && none == 0));
    const auto [wall, wall_light] = seen("SDIC_tutorial/world/robot_iqr", {3.9, 0, 0});
    CHECK(wall == Approx((2 - 1 / std::cos(off)) / 2).margin(1e-6));  // its face at 4.9
    CHECK(wall_light == Approx((2.5 - 1 / std::cos(off)) / 2.5).margin(1e-6));
    CHECK(seen("SDIC_tutorial/world/follow_line", {0, 0.2, pi / 2}).second > 0.5);
}

TEST_CASE("A robot drives along the line and sees it green; the strips are paint") {
    if (absent(shared_dir() / "original")) return;
    const auto world = made(original("SDIC_tutorial/world/follow_line"));
    CHECK(world->movable_objects() == 0);
    CHECK(mean(*world, 1) > 240);
    CHECK(mean(*world, 0) < 15);
    world->command(0, {1, 0});
    for (int cycle = 0; cycle < 25; ++cycle) world->step();
    CHECK(world->pose(0).x == Approx(-5.3 + 1));
    CHECK(world->pose(0).y == Approx(-3.8));
    CHECK(strongest(world->snapshot(0).proximity) == 0);
    // Beside the line the floor is grey: the strip from (-5.2, -3.8) is 0.4 m wide.
    const auto beside = with_robot_at("SDIC_tutorial/world/follow_line", {-5.3, -4.6, 0});
    CHECK(mean(*beside, 0) == Approx(mean(*beside, 1)).margin(1));
}

TEST_CASE("Light and shade: grey floor with and without a sun, black homes") {
    if (absent(shared_dir() / "original")) return;
    const auto sunny = with_robot_at("DAC_files/DAC_basic_apprach_avoid_arena", {0, 0, 0}),
               dark = with_robot_at("SDIC_challenge/SDIC_arena", {3, 3.5, 0}),
               home = with_robot_at("DAC_files/DAC_approach_avoid_arena", {0, 7, 0});
    CHECK(mean(*sunny, 0) == Approx(0.729 * 255).margin(1));
    CHECK(mean(*dark, 0) == Approx(0.120 * 255).margin(1));
    CHECK(mean(*home, 2) > 150);
    const auto black = with_robot_at("SDIC_challenge/SDIC_one_robot_arena", {-9.3, 8.2, pi / 2});
    const auto picture = black->image(0);
    CHECK(std::count(picture.begin(), picture.end(), 0) > static_cast<std::ptrdiff_t>(picture.size() / 3));
}

TEST_CASE(
    "Teams have green robots (team A) and red robots (team B) with the names and poses of the "
    "specification") {
    if (absent(shared_dir() / "original")) return;
    const std::map<std::string, Pose2> places = {
        {"TeamA_Bug_01", {-9.5, 7, -1.57079}},   {"TeamA_Bug_02", {-7, 9.5, 0}},
        {"TeamA_Bug_03", {-8.7, 7.8, -1.57079}}, {"TeamA_Bug_04", {-7.8, 8.7, 0}},
        {"TeamB_Bug_01", {9.5, -7, 1.57079}},    {"TeamB_Bug_02", {7, -9.5, 3.14159}},
        {"TeamB_Bug_03", {8.7, -7.8, 1.57079}},  {"TeamB_Bug_04", {7.8, -8.7, 3.14159}}};
    const auto world = made(original("SDIC_challenge/SDIC_arena"));
    REQUIRE(world->bugs() == places.size());
    for (std::size_t i = 0; i < world->bugs(); ++i) {
        const std::string name = world->robot_names()[i];
        INFO(name);
        const Pose2& at = places.at(name);
        CHECK((world->pose(i).x == at.x && world->pose(i).y == at.y));
        CHECK(world->pose(i).yaw == Approx(at.yaw));
        const auto body = std::find_if(world->robot(i).visuals.begin(), world->robot(i).visuals.end(),
                                       [](const MovingVisual& s) { return s.of_body_link; });
        REQUIRE(body != world->robot(i).visuals.end());
        const Colour& colour = body->visual.material.diffuse;
        const bool green = name.starts_with("TeamA");
        CHECK((colour[0] == (green ? 0 : 1) && colour[1] == (green ? 1 : 0) && colour[2] == 0));
    }
}
