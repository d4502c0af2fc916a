#include "bug_interface/motion/physics.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "tests/support/catch.h"
#include "tests/support/overlap.h"
#include "tests/unit/bug_interface/physics_step.h"

using namespace forage::bug;
using forage::test::physics_step_s;
using forage::test::step;
using std::numbers::pi;
using Stepping = Physics::Stepping;

namespace {

constexpr double robot_radius = 0.2;

Obstacle box(double x, double y, double yaw, double size_x, double size_y) {
    Obstacle o;
    o.outline.x = x, o.outline.y = y, o.outline.cos_yaw = std::cos(yaw), o.outline.sin_yaw = std::sin(yaw);
    o.outline.half_x = size_x / 2, o.outline.half_y = size_y / 2;
    return o;
}

Obstacle pillar(double x, double y, double r) {
    Obstacle o;
    o.outline.round = true, o.outline.x = x, o.outline.y = y, o.outline.radius = r;
    return o;
}

/// The distance of a robot's centre from the edge of an outline, m; negative inside.
double distance(const Obstacle& obstacle, const Pose2& p) {
    const Outline& o = obstacle.outline;
    const double dx = p.x - o.x, dy = p.y - o.y;
    if (o.round) return std::hypot(dx, dy) - o.radius;
    const double ox = std::abs(o.cos_yaw * dx + o.sin_yaw * dy) - o.half_x,
                 oy = std::abs(o.cos_yaw * dy - o.sin_yaw * dx) - o.half_y;
    return std::hypot(std::max(0.0, ox), std::max(0.0, oy)) + std::min(0.0, std::max(ox, oy));
}

struct OneRobot {
    std::vector<Obstacle> obstacles;
    Physics physics;
    OneRobot(std::vector<Obstacle> o, Pose2 start, Stepping stepping = Stepping::strides)
        : obstacles(std::move(o)), physics(obstacles, std::vector<Body>(1), physics_step_s, stepping) {
        physics.place(0, start);
    }
    void drive(MotorCommand command, int steps = 1) {
        for (int i = 0; i < steps; ++i) step(physics, std::array{command});
    }
    double gap() const {
        double least = 1e9;
        for (const auto& o : obstacles) least = std::min(least, distance(o, physics.pose(0)) - robot_radius);
        return least;
    }
    const Pose2& pose() const { return physics.pose(0); }
};

const std::vector<Obstacle> furnished_room = {box(0, 1.1, 0, 6, 0.2),         box(0, -1.1, 0, 6, 0.2),
                                              box(1.6, 0, pi / 2, 6, 0.2),    box(-1.6, 0, pi / 2, 6, 0.2),
                                              box(1.2, 0.7, -pi / 4, 1, 0.2), pillar(-0.5, 0.2, 0.25),
                                              box(0.6, -0.4, 0.3, 0.2, 0.2)};

}  // namespace

TEST_CASE("Far from everything, a robot moves by Euler steps") {
    OneRobot r({box(0, 10, 0, 5, 0.2)}, {0, 0, 0.5});
    double x = 0, y = 0, yaw = 0.5;
    for (int i = 0; i < 1000; ++i)
        x += 0.8 * std::cos(yaw) * physics_step_s, y += 0.8 * std::sin(yaw) * physics_step_s,
            yaw += 0.7 * physics_step_s;
    r.drive({0.8, 0.7}, 1000);
    CHECK(r.pose().x == x);
    CHECK(r.pose().y == y);
    CHECK(r.pose().yaw == yaw);
    CHECK(r.physics.contact_steps() == 0);
}

TEST_CASE("The yaw stays in (-pi, pi]") {
    OneRobot r({}, {0, 0, 3});
    r.drive({0, 1}, 1000);
    CHECK(r.pose().yaw == Approx(4 - 2 * pi));
    r.drive({0, -1}, 1000);
    CHECK(r.pose().yaw == Approx(3));
}

TEST_CASE(
    "A step is the same when contacts are looked for everywhere, and without contacts it has the same bits") {
    OneRobot near(furnished_room, {0, 0, 0.5}), everywhere(furnished_room, {0, 0, 0.5}, Stepping::single);
    const forage::RandomStream random(3, "drive");
    int touching = 0, farther = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const MotorCommand c{2 * random.uniform(i / 50, 0) - 0.6, 6 * random.uniform(i / 50, 1) - 3};
        everywhere.physics.place(0, near.pose());
        const auto contacts = near.physics.contact_steps();
        near.drive(c), everywhere.drive(c);
        const Pose2 &a = near.pose(), &b = everywhere.pose();
        INFO("step " << i);
        if (near.physics.contact_steps() == contacts) {
            REQUIRE((a.x == b.x && a.y == b.y && a.yaw == b.yaw));
            continue;
        }
        ++touching;
        REQUIRE(std::hypot(a.x - b.x, a.y - b.y) < 1e-4);
        REQUIRE(std::abs(std::remainder(a.yaw - b.yaw, 2 * pi)) < 1e-4);
        farther += std::hypot(a.x - b.x, a.y - b.y) > 2e-6;
    }
    INFO(touching << " steps with contacts, " << farther << " of them differ");
    CHECK(touching > 3000);
    CHECK(farther < touching / 100);
}

TEST_CASE("A fast robot does not run into a slow one, whatever their order") {
    for (const bool slow_first : {true, false}) {
        const std::size_t slow = slow_first ? 0 : 1, fast = 1 - slow;
        for (const double speed : {8.0, 15.0, 30.0}) {
            for (double apart = 1; apart < 1.3; apart += 0.0137) {
                Physics p({}, std::vector<Body>(2), physics_step_s);
                p.place(slow, {apart, 0, 0}), p.place(fast, {0, 0, 0});
                std::array<MotorCommand, 2> drives{};
                drives[fast].forward = speed, drives[slow].forward = 0.5;
                for (int i = 0; i < 100; ++i) {
                    step(p, drives);
                    INFO(speed << " m/s, step " << i);
                    REQUIRE(p.pose(slow).x - p.pose(fast).x > 2 * robot_radius - 0.001);
                }
            }
        }
    }
}

TEST_CASE("A robot that was placed in a wall is not pushed out of it and does not get deeper") {
    OneRobot r({box(1, 0, 0, 0.2, 4)}, {0.8, 0, 0});  // 0.1 m deep
    r.drive({1, 0.3}, 1000);
    CHECK(r.pose().x == Approx(0.8).margin(1e-5));
    r.drive({-1, 0}, 1000);
    CHECK(r.pose().x < 0.3);
}

TEST_CASE("An object that is hit by a fast robot does not penetrate the next one") {
    Body ball;
    ball.driven = false, ball.radius = 0.08, ball.mass = 0.01, ball.inertia = 1;
    const std::array<Body, 3> bodies = {Body{}, ball, ball};
    for (const double speed : {1.0, 8.0, 30.0})
        for (double gap = 0.0005; gap < 0.06; gap *= 1.3) {
            Physics p({}, bodies, physics_step_s);
            p.place(0, {0, 0, 0}), p.place(1, {0.35, 0, 0}), p.place(2, {0.35 + 2 * ball.radius + gap, 0, 0});
            for (int i = 0; i < 200; ++i) {
                step(p, std::array<MotorCommand, 3>{{{speed, 0}, {}, {}}});
                INFO(speed << " m/s, " << gap << " m, step " << i);
                REQUIRE(p.pose(1).x - p.pose(0).x > robot_radius + ball.radius - 0.001);
                REQUIRE(p.pose(2).x - p.pose(1).x > 2 * ball.radius - 0.001);
            }
        }
}

TEST_CASE("Objects that overlap at rest stay where they are") {
    Body ball;
    ball.driven = false, ball.radius = 0.08, ball.mass = 0.01, ball.inertia = 1;
    const std::array<Body, 3> bodies = {Body{}, ball, ball};
    for (const auto when : {Stepping::strides, Stepping::single}) {
        Physics p({}, bodies, physics_step_s, when);
        p.place(0, {5, 0, 0}), p.place(1, {0, 0, 0}), p.place(2, {2 * ball.radius - 0.0007, 0, 0});
        for (int i = 0; i < 100; ++i) step(p, std::array<MotorCommand, 3>{{{0.1, 0.1}, {}, {}}});
        CHECK(p.pose(2).x == 2 * ball.radius - 0.0007);
        CHECK(p.pose(1).x == 0);
    }
}

TEST_CASE("A robot that is squeezed between two crates and a wall penetrates none of them") {
    // The wall is in front, and two heavy crates come from the sides, corners first.
    Body crate;
    crate.radius = 0, crate.mass = 50, crate.inertia = 5, crate.driven = true;
    crate.parts = {{box(0, 0, pi / 4, 0.3, 0.3).outline, 0, 0.1}};
    const std::array<Body, 3> bodies = {Body{}, crate, crate};
    const std::array<Obstacle, 1> wall = {box(0.4, 0, 0, 0.2, 4)};
    Physics p(wall, bodies, physics_step_s);
    p.place(0, {0, 0, 0}), p.place(1, {-0.1, 0.8, -pi / 2}), p.place(2, {-0.1, -0.8, pi / 2});
    for (int i = 0; i < 1500; ++i) {
        step(p, std::array<MotorCommand, 3>{{{1, 0.5}, {1, 0.1}, {1, -0.2}}});
        Outline round;
        round.round = true, round.x = p.pose(0).x, round.y = p.pose(0).y, round.radius = robot_radius;
        REQUIRE(overlap(wall[0].outline, round).depth < 0.001);
        for (const std::size_t c : {1u, 2u})
            REQUIRE(overlap(Transform2(p.pose(c)) * p.parts(c)[0].outline, round).depth < 0.001);
    }
}

TEST_CASE("A robot stops at a wall, at the distance of its radius") {
    for (const double yaw : {0.0, 0.4, pi / 2}) {
        OneRobot r({box(std::cos(yaw), std::sin(yaw), yaw, 0.2, 4)}, {0, 0, yaw});
        r.drive({1, 0}, 1500);
        CHECK(std::hypot(r.pose().x, r.pose().y) == Approx(0.7).margin(2e-4));
        CHECK(r.pose().yaw == Approx(yaw).margin(1e-3));
    }
}

TEST_CASE("A robot stops at a corner and at a pillar, at the distance of its radius") {
    OneRobot corner({box(1, 0, pi / 4, 0.4, 0.4)}, {0, 0, 0});
    corner.drive({1, 0}, 1500);
    CHECK(corner.pose().x == Approx(1 - 0.2 * std::sqrt(2.0) - robot_radius).margin(5e-4));
    OneRobot round({pillar(1, 0, 0.3)}, {0, 0, 0});
    round.drive({1, 0}, 1500);
    CHECK(round.pose().x == Approx(0.5).margin(2e-4));
}

TEST_CASE("A robot that meets a wall at 45 degrees slides along it and slowly turns into it") {
    OneRobot r({box(0, 1.1, 0, 40, 0.2)}, {0, 0.7999, pi / 4});  // touching, wall front at y = 1
    r.drive({1, 0});
    const double v = std::sqrt(0.5);
    const Pose2 before = r.pose();
    r.drive({1, 0}, 20);
    CHECK((r.pose().x - before.x) / 0.02 == Approx(v - 0.1 * v).epsilon(0.01));  // 0.636 m/s
    CHECK((r.pose().yaw - before.yaw) / 0.02 == Approx(0.1 * v).epsilon(0.01));  // 0.07 rad/s
    CHECK(r.gap() > -1e-4);
    // From here on the heading drifts and the robot slows down.
    double x = r.pose().x, yaw = r.pose().yaw;
    for (int i = 0; i < 2000; ++i)
        x += (std::cos(yaw) - 0.1 * std::sin(yaw)) * physics_step_s,
            yaw += 0.1 * std::sin(yaw) * physics_step_s;
    r.drive({1, 0}, 2000);
    CHECK(r.pose().x == Approx(x).margin(0.005));
    CHECK(r.pose().yaw == Approx(yaw).margin(0.002));
    CHECK(std::abs(r.gap()) < 1e-4);
}

TEST_CASE("Within 5.7 degrees of head-on a robot sticks to the wall") {
    OneRobot sticks({box(0, 1.1, 0, 40, 0.2)}, {0, 0.7999, pi / 2 - 0.09}),
        slides({box(0, 1.1, 0, 40, 0.2)}, {0, 0.7999, pi / 2 - 0.12});
    sticks.drive({1, 0}, 100), slides.drive({1, 0}, 100);
    CHECK(std::abs(sticks.pose().x) < 2e-3);
    CHECK(slides.pose().x == Approx(0.1 * (0.12 - 0.1)).epsilon(0.3));
}

TEST_CASE("A robot can drive away from a wall") {
    OneRobot r({box(0, 1.1, 0, 40, 0.2)}, {0, 0.5, pi / 2});
    r.drive({1, 0}, 500);
    CHECK(r.pose().y == Approx(0.8).margin(1e-4));
    r.drive({-1, 0}, 500);
    CHECK(r.pose().y == Approx(0.3).margin(1e-4));
}

TEST_CASE("Random commands in a crowded room never lead through a wall or to infinite numbers") {
    OneRobot r(furnished_room, {0, 0, 0});
    const forage::RandomStream random(7, "drive");
    double deepest = 0, farthest = 0;
    int touching = 0;
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const Pose2 before = r.pose();
        r.drive({3 * random.uniform(i / 200, 0) - 1, 8 * random.uniform(i / 200, 1) - 4});
        deepest = std::max(deepest, -r.gap());
        farthest = std::max(farthest, std::hypot(r.pose().x - before.x, r.pose().y - before.y));
        touching += r.gap() < 1e-4;
    }
    INFO("deepest " << deepest << " m, touching in " << touching << " steps");
    CHECK(touching > 10000);
    CHECK(deepest < 0.001);
    CHECK(farthest < 0.0021);
}

TEST_CASE("Robots stop each other head-on, and one that stands still is pushed at half speed") {
    std::vector<Body> bodies(2);
    Physics head_on({}, bodies, physics_step_s);
    head_on.place(0, {-1, 0, 0});
    head_on.place(1, {1, 0, pi});
    for (int i = 0; i < 2000; ++i) step(head_on, std::array{MotorCommand{1, 0}, MotorCommand{1, 0}});
    CHECK(head_on.pose(0).x == Approx(-0.2).margin(1e-3));
    CHECK(head_on.pose(1).x == Approx(0.2).margin(1e-3));

    Physics push({}, bodies, physics_step_s);
    push.place(0, {-1, 0, 0});
    push.place(1, {0, 0, 0});
    for (int i = 0; i < 600; ++i) step(push, std::array{MotorCommand{1, 0}, MotorCommand{0, 0}});
    const double before = push.pose(1).x;
    CHECK(before == Approx(0).margin(1e-3));
    for (int i = 0; i < 1000; ++i) step(push, std::array{MotorCommand{1, 0}, MotorCommand{0, 0}});
    CHECK(push.pose(1).x - before == Approx(0.5).margin(0.01));
    CHECK(push.pose(1).x - push.pose(0).x == Approx(0.4).margin(1e-3));
}

TEST_CASE("A crowd of robots in a room does not overlap") {
    constexpr std::size_t n = 6;
    Physics crowd(furnished_room, std::vector<Body>(n), physics_step_s);
    for (std::size_t i = 0; i < n; ++i) crowd.place(i, {-1.2 + 0.45 * static_cast<double>(i), -0.75, pi / 2});
    const forage::RandomStream random(5, "crowd");
    double deepest = 0;
    std::array<MotorCommand, n> drives;
    for (std::uint64_t s = 0; s < 20000; ++s) {
        for (std::size_t i = 0; i < n; ++i) {
            const auto index = static_cast<std::uint32_t>(2 * i);
            drives[i] = {1.5 * random.uniform(s / 300, index) - 0.3,
                         6 * random.uniform(s / 300, index + 1) - 3};
        }
        step(crowd, drives);
        for (std::size_t i = 0; i < n; ++i) {
            const Pose2& a = crowd.pose(i);
            for (std::size_t j = 0; j < i; ++j)
                deepest = std::max(deepest, 0.4 - std::hypot(a.x - crowd.pose(j).x, a.y - crowd.pose(j).y));
            for (const auto& o : furnished_room) deepest = std::max(deepest, robot_radius - distance(o, a));
        }
    }
    INFO("deepest " << deepest);
    CHECK(deepest < 0.001);
}

TEST_CASE("A removed robot touches nothing and does not move") {
    Physics p({}, std::vector<Body>(2), physics_step_s);
    p.place(0, {-1, 0, 0});
    p.place(1, {0, 0, 0});
    p.remove(1);
    for (int i = 0; i < 2000; ++i) step(p, std::array{MotorCommand{1, 0}, MotorCommand{1, 0}});
    CHECK(p.pose(0).x == Approx(1));
    CHECK(p.pose(1).x == 0);
}
