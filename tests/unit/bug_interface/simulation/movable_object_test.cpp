// Movable objects that are pushed, blocked, at different heights, and held by a gripper.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "tests/support/overlap.h"
#include "tests/unit/bug_interface/physics_step.h"
#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;
using std::numbers::pi;
using test::apart;
using test::description;
using test::make_world;
using test::physics_step_s;
using test::step;

namespace {

Body ball(double radius = 0.08, double mass = 0.01) {
    Body b;
    b.radius = radius, b.mass = mass, b.driven = false, b.deceleration = 0.98;
    return b;
}

Body crate(double side, double mass) {
    Body b;
    Outline o;
    o.half_x = o.half_y = side / 2;
    b.radius = 0, b.mass = mass, b.inertia = mass * side * side / 6, b.driven = false, b.deceleration = 0.98;
    b.angular_deceleration = 3;
    b.parts.push_back({o, 0, 0.1});
    return b;
}

Outline wall(double x, double y, double size_x, double size_y) {
    Outline o;
    o.x = x, o.y = y, o.half_x = size_x / 2, o.half_y = size_y / 2;
    return o;
}

/// The team arena with a ball in front of the robot A_1, far from all walls.
struct Court {
    std::unique_ptr<World> world;
    explicit Court(double ahead = 0.33, double aside = 0) {
        WorldDescription text = description("team_arena");
        text.game.reset();
        std::erase_if(text.models, [](const Model& m) {
            return m.name != "A_1" && m.name != "Floor" && m.name != "Walls";
        });
        for (Model& m : text.models)
            if (m.name == "A_1") m.pose = in_space({0, 0, 0});
        Model target;
        target.name = "Ball";
        Link link;
        link.name = "body", link.mass = 0.01, link.pose.translation().z() = 0.06;
        const Shape shape{ShapeKind::sphere, Eigen::Vector3d::Constant(0.16)};
        link.collisions.push_back({{}, "c", Pose::Identity(), shape, 0.1});
        link.visuals.push_back({{}, "v", Pose::Identity(), shape, {}});
        target.links.push_back(link);
        target.pose.translation() = Eigen::Vector3d(ahead, aside, 0);
        text.models.push_back(target);
        world = make_world(text);
        world->request_gripper_scan(0, true);
    }
    void drive(MotorCommand command, int cycles) {
        world->command(0, command);
        for (int i = 0; i < cycles; ++i) world->step();
    }
    /// The position of the ball in the frame of the robot.
    Eigen::Vector2d seen() const {
        const Pose2 &r = world->pose(0), b = *world->movable_object_pose(0);
        return Eigen::Rotation2Dd(-r.yaw) * Eigen::Vector2d(b.x - r.x, b.y - r.y);
    }
};

}  // namespace

TEST_CASE("A pushed ball moves ahead of the robot, and slides until friction stops it when the robot stops") {
    Physics p({}, std::vector<Body>{Body{}, ball()}, physics_step_s);
    p.place(0, {0, 0, 0});
    p.place(1, {0.5, 0, 0});
    for (int i = 0; i < 1000; ++i) step(p, std::array{MotorCommand{1, 0}, MotorCommand{}});
    CHECK(p.pose(0).x == Approx(1).margin(2e-3));
    CHECK(apart(p.pose(0), p.pose(1)) == Approx(0.28).margin(1e-3));
    const double before = p.pose(1).x;
    for (int i = 0; i < 2000; ++i) step(p, std::array{MotorCommand{-1, 0}, MotorCommand{}});
    CHECK(p.pose(1).x - before == Approx(1 / (2 * 0.98)).epsilon(0.01));  // v^2 / 2 a
    CHECK(p.speed(1) == 0);
}

TEST_CASE("A ball between a robot and a wall stops the robot") {
    std::vector<Obstacle> walls(1);
    walls[0].outline = wall(1.1, 0, 0.2, 4);
    Physics p(walls, std::vector<Body>{Body{}, ball()}, physics_step_s);
    p.place(0, {0, 0, 0});
    p.place(1, {0.6, 0, 0});
    double deepest = 0;
    for (int i = 0; i < 3000; ++i) {
        step(p, std::array{MotorCommand{1, 0}, MotorCommand{}});
        deepest = std::max({deepest, p.pose(1).x + 0.08 - 1, 0.28 - apart(p.pose(0), p.pose(1))});
    }
    CHECK(deepest < 0.001);
    CHECK(p.pose(0).x == Approx(1 - 0.36).margin(0.002));
}

TEST_CASE("A crate that is pushed off its centre turns") {
    Physics p({}, std::vector<Body>{Body{}, crate(0.3, 0.5)}, physics_step_s);
    p.place(0, {0, 0.1, 0});
    p.place(1, {0.6, 0, 0});
    for (int i = 0; i < 1200; ++i) step(p, std::array{MotorCommand{0.5, 0}, MotorCommand{}});
    CHECK(p.pose(1).x > 0.7);
    CHECK(p.pose(1).yaw < -0.05);
}

TEST_CASE("Shapes touch only if they share heights") {
    // A low robot passes below the beam that stops a high robot.
    std::vector<Obstacle> beam(1);
    beam[0].outline = wall(1, 0, 0.2, 4), beam[0].layers = 2;
    Body low, high;
    high.layer = 1;
    Physics p(beam, std::vector<Body>{low, high}, physics_step_s, Physics::Stepping::strides, {1, 2});
    p.place(0, {0, 0, 0}), p.place(1, {0, 0, 0});
    for (int i = 0; i < 2000; ++i) step(p, std::array{MotorCommand{1, 0}, MotorCommand{1, 0}});
    CHECK(p.pose(0).x == Approx(2));
    CHECK(p.pose(1).x == Approx(0.7).margin(1e-3));
}

TEST_CASE(
    "In a million steps of random commands among walls, balls and crates, nothing penetrates, and no energy "
    "appears",
    "[long]") {
    std::vector<Obstacle> walls(5);
    walls[0].outline = wall(0, 2.1, 5, 0.2), walls[1].outline = wall(0, -2.1, 5, 0.2);
    walls[2].outline = wall(2.1, 0, 0.2, 5), walls[3].outline = wall(-2.1, 0, 0.2, 5);
    walls[4].outline.round = true, walls[4].outline.radius = 0.4;
    const std::vector<Body> bodies = {Body{}, Body{}, ball(), ball(), ball(0.15, 0.5), crate(0.3, 0.5)};
    Physics p(walls, bodies, physics_step_s);
    const std::array<Pose2, 6> places = {Pose2{-1, -1, 0}, {1, 1, 2},    {-1, 1, 0},
                                         {1, -1, 0},       {-1.4, 0, 0}, {1.4, 0, 0}};
    for (std::size_t i = 0; i < places.size(); ++i) p.place(i, places[i]);
    const RandomStream random(11, "drive");
    std::array<MotorCommand, 6> drives{};
    double fastest = 0, deepest_wall = 0, farthest = 0;
    for (std::uint64_t step = 0; step < 1000000; ++step) {
        if (step % 100 == 0)
            for (std::uint32_t i = 0; i < 2; ++i)
                drives[i] = {2 * random.uniform(step, 2 * i) - 0.8, 4 * random.uniform(step, 2 * i + 1) - 2};
        test::step(p, drives);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            fastest = std::max(fastest, p.speed(i));
            farthest = std::max({farthest, std::abs(p.pose(i).x), std::abs(p.pose(i).y)});
            if (i == 5) continue;
            Outline o;
            o.round = true, o.x = p.pose(i).x, o.y = p.pose(i).y, o.radius = bodies[i].radius;
            for (const Obstacle& w : walls)
                deepest_wall = std::max(deepest_wall, overlap(w.outline, o).depth);
        }
    }
    INFO("fastest " << fastest << ", deepest " << deepest_wall);
    CHECK(fastest < 1.3 * 1.5);  // a ball that is squeezed out may be slightly faster than what pushes it
    CHECK(deepest_wall < 0.001);
    CHECK(farthest < 2);
}

TEST_CASE(
    "A gripper closes only after it was opened, at the speed of its hinges, and its rays see the ball") {
    Court court(1.5);
    const auto angle = [&](std::size_t hinge) { return court.world->gripper_angle(0, hinge); };
    court.world->grip(0, true);
    court.drive({}, 20);
    CHECK(angle(0) == 0);
    court.world->grip(0, false);
    court.drive({}, 20);
    CHECK(angle(0) == Approx(-0.2));
    court.world->grip(0, true);
    court.drive({}, 5);  // 0.2 s at 3 / (0.001 + 0.001) * 0.001 = 1.5 rad/s
    CHECK(angle(0) == Approx(0.1).margin(0.01));
    court.drive({}, 20);
    CHECK(angle(0) == Approx(0.45));
    CHECK(angle(1) == Approx(0.6));
}

TEST_CASE("A gripped ball stays gripped while the robot turns, drives, brakes and reverses") {
    for (const double aside : {0.0, 0.03, -0.04}) {
        Court court(0.34, aside);
        court.world->grip(0, false);
        court.drive({}, 10);
        court.world->grip(0, true);
        court.drive({}, 20);
        const double angle = court.world->gripper_angle(0, 0);
        CHECK(angle < 0.44);  // the ball is between the fingers
        CHECK(court.world->snapshot(0).gripper[7] > 0.5);
        for (const MotorCommand& command :
             {MotorCommand{0.8, 0}, {0, 1.5}, {0, -1.5}, {-0.8, 0}, {0.5, 1}, {-0.5, -1}, {0, 0}})
            for (int i = 0; i < 40; ++i) {
                court.drive(command, 1);
                const Eigen::Vector2d at = court.seen();
                INFO(at.x() << " " << at.y());
                REQUIRE((at.x() > 0.25 && at.x() < 0.4 && std::abs(at.y()) < 0.06));
            }
        court.world->grip(0, false);
        court.drive({-0.5, 0}, 40);
        CHECK(court.seen().x() > 0.6);
    }
}
