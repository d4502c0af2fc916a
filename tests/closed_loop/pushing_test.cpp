// Long random pushing of balls and crates by robots with grippers. The environment variable
// FORAGE_PUSHING_STEPS sets the number of steps.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "tests/support/overlap.h"
#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;

namespace {

constexpr double pi = std::numbers::pi;

Model block(const std::string& name, const Pose2& at, const Shape& shape, double mass, bool fixed = false) {
    Model model;
    model.name = name, model.is_static = fixed, model.pose = in_space(at);
    Link link;
    link.name = "body", link.mass = mass;
    link.inertia_z = mass * (shape.size.x() * shape.size.x() + shape.size.y() * shape.size.y()) / 12;
    link.pose.translation().z() = shape.size.z() / 2;
    link.collisions.push_back({{}, "c", Pose::Identity(), shape, fixed ? 1.0 : 0.1});
    link.visuals.push_back({{}, "v", Pose::Identity(), shape, {}});
    model.links.push_back(link);
    return model;
}
Model box(const std::string& name, const Pose2& at, double x, double y, double mass, bool fixed = false) {
    return block(name, at, {ShapeKind::box, {x, y, fixed ? 0.25 : 0.2}}, mass, fixed);
}
Model ball(const std::string& name, const Pose2& at) {
    return block(name, at, {ShapeKind::sphere, Eigen::Vector3d::Constant(0.16)}, 0.01);
}

/// A square arena of `side` m with robots of the team arena and other models.
WorldDescription pen(double side, const std::vector<Pose2>& robots, const std::vector<Model>& things) {
    WorldDescription world = test::description("team_arena");
    const Model robot = *test::find_model(world, "A_1");
    world.game.reset();
    std::erase_if(world.models, [](const Model& m) { return m.name != "Floor" && m.name != "Sun"; });
    for (int i = 0; i < 4; ++i) {
        const double turn = i * pi / 2, middle = side / 2 + 0.1;
        world.models.push_back(box("wall_" + std::to_string(i),
                                   {middle * std::cos(turn), middle * std::sin(turn), turn}, 0.2, side + 0.4,
                                   1, true));
    }
    for (std::size_t i = 0; i < robots.size(); ++i) {
        world.models.push_back(robot);
        world.models.back().name = "robot_" + std::to_string(i);
        world.models.back().pose = in_space(robots[i]);
    }
    for (const Model& thing : things) world.models.push_back(thing);
    return world;
}

/// A world that is measured after every cycle of one or more steps of 1 ms.
class Pen {
  public:
    explicit Pen(const WorldDescription& text, int steps_per_cycle = 1) {
        WorldOptions options;
        options.cycles_per_second = 1000.0 / steps_per_cycle, options.real_time_factor = 1;
        world = test::make_world(text, options);
        for (const Model& m : text.models)
            if (m.is_static)
                for (const Solid& solid : solids_of(m))
                    if (const auto outline = cross_section(solid, 0.08)) walls_.push_back(*outline);
    }
    void step() {
        world->advance_bodies();
        for (std::size_t i = 0; i < bodies(); ++i) measure(i);
    }
    std::size_t bodies() const { return world->bugs() + world->movable_objects(); }

    std::unique_ptr<World> world;
    std::map<std::string, double> deepest;  ///< of "robot wall", "crate crate", ..., m
    double fastest = 0, farthest = 0, fastest_turn = 0;

  private:
    std::string kind(std::size_t body) const {
        if (body < world->bugs()) return "robot";
        return world->movable_object(body - world->bugs()).name.substr(0, 4) == "ball" ? "ball" : "crate";
    }
    /// The shapes of a body in world coordinates; the central disc comes first.
    std::vector<Outline> shapes(std::size_t body) const {
        const Pose2& pose = world->physics().pose(body);
        std::vector<Outline> out;
        if (kind(body) != "crate") {
            Outline middle;
            middle.round = true, middle.x = pose.x, middle.y = pose.y;
            middle.radius = kind(body) == "robot" ? 0.2 : 0.08;
            out.push_back(middle);
        }
        for (const Part& part : world->physics().parts(body)) out.push_back(Transform2(pose) * part.outline);
        return out;
    }
    void measure(std::size_t body) {
        const Physics& physics = world->physics();
        fastest = std::max(fastest, physics.speed(body));
        fastest_turn = std::max(fastest_turn, std::abs(physics.angular_velocity(body)));
        const Pose2& at = physics.pose(body);
        if (!(std::abs(at.x) < 1e3 && std::abs(at.y) < 1e3 && std::abs(at.yaw) < 4))
            farthest = 1e9;  // NaN too
        farthest = std::max({farthest, std::abs(at.x), std::abs(at.y)});
        const auto own = shapes(body);
        const auto note = [&](const std::string& pair, const Outline& a, const Outline& b) {
            double& depth = deepest[pair];
            depth = std::max(depth, overlap(a, b).depth);
        };
        for (const Outline& shape : own)
            for (const Outline& wall : walls_) note(kind(body) + " wall", wall, shape);
        for (std::size_t other = 0; other < body; ++other) {
            const Pose2& there = physics.pose(other);
            if (std::hypot(there.x - at.x, there.y - at.y) > 1.1) continue;
            for (const Outline& a : shapes(other))
                for (const Outline& b : own) note(kind(other) + " " + kind(body), a, b);
        }
    }
    std::vector<Outline> walls_;
};

std::uint64_t steps_to_do() {
    const char* wanted = std::getenv("FORAGE_PUSHING_STEPS");
    return wanted ? std::strtoull(wanted, nullptr, 10) : 200000;
}

}  // namespace

TEST_CASE("Random driving and gripping among crates and balls: nothing penetrates, and no energy appears") {
    const int cycle = GENERATE(1, 40);
    INFO(cycle << " steps per cycle");
    Pen pen(::pen(3.2, {{-1, -1, 0}, {1, 1, 3}, {-1, 1, -1}},
                  {box("crate_1", {0, 0, 0.3}, 0.3, 0.3, 0.5), box("crate_2", {0.9, -0.6, 1}, 0.4, 0.25, 3),
                   box("crate_3", {-0.2, -0.8, 0}, 0.25, 0.25, 0.2), ball("ball_1", {0.4, 0.5, 0}),
                   ball("ball_2", {1, -1.2, 0}), ball("ball_3", {-1.2, 0, 0})}),
            cycle);
    World& world = *pen.world;
    std::vector<Pose2> before;
    for (std::size_t i = 0; i < world.movable_objects(); ++i) before.push_back(*world.movable_object_pose(i));
    const RandomStream random(17, "push");
    const std::uint64_t cycles =
        cycle == 1 ? steps_to_do() : 5 * steps_to_do() / static_cast<std::uint64_t>(cycle);
    for (std::uint64_t t = 0; t < cycles; ++t) {
        if (t % (cycle == 1 ? 250 : 6) == 0)
            for (std::uint32_t i = 0; i < 3; ++i) {
                world.command(i, {2 * random.uniform(t, 3 * i) - 0.7, 4 * random.uniform(t, 3 * i + 1) - 2});
                world.grip(i, random.uniform(t / (cycle == 1 ? 1000 : 25), 3 * i + 2) < 0.5);
            }
        pen.step();
    }
    std::string depths;
    for (const auto& [what, depth] : pen.deepest)
        depths += what + " " + std::to_string(1e3 * depth) + " mm, ";
    INFO(depths << "fastest " << pen.fastest << " m/s, " << pen.fastest_turn << " rad/s");
    for (const char* met : {"robot wall", "robot robot", "robot crate", "robot ball", "crate wall",
                            "crate crate", "crate ball", "ball wall"})
        CHECK(pen.deepest.contains(met));
    for (const auto& [what, depth] : pen.deepest) {
        INFO(what);
        CHECK(depth < 1e-3);
    }
    // An object that is squeezed out may be faster than what pushes it.
    CHECK(pen.fastest < 1.5 * (1.3 + 0.5 * 2));
    CHECK(pen.fastest_turn < 30);
    CHECK(pen.farthest < 1.6);
    int moved = 0;
    for (std::size_t i = 0; i < world.movable_objects(); ++i)
        moved += std::hypot(world.movable_object_pose(i)->x - before[i].x,
                            world.movable_object_pose(i)->y - before[i].y) > 0.02;
    CHECK(moved >= 4);
}

TEST_CASE("A gripped ball stays gripped at walls, does not penetrate them, and is released on command") {
    const int cycle = GENERATE(1, 40);
    for (int run = 0; run < 6; ++run) {
        Pen pen(::pen(2.4, {{0, 0, 0.4 * run}},
                      {ball("ball_1", {0.34 * std::cos(0.4 * run), 0.34 * std::sin(0.4 * run), 0})}),
                cycle);
        World& world = *pen.world;
        const auto drive = [&](MotorCommand command, int steps, bool check) {
            world.command(0, command);
            for (int i = 0; i < steps / cycle; ++i) {
                pen.step();
                if (!check) continue;
                const Pose2 &r = world.pose(0), b = *world.movable_object_pose(0);
                const Eigen::Vector2d at = Eigen::Rotation2Dd(-r.yaw) * Eigen::Vector2d(b.x - r.x, b.y - r.y);
                INFO("run " << run << ", " << at.x() << " " << at.y() << ", " << command.forward << " "
                            << command.turn);
                REQUIRE((at.x() > 0.25 && at.x() < 0.41 && std::abs(at.y()) < 0.07));
            }
        };
        world.grip(0, false);
        drive({}, 400, false);
        world.grip(0, true);
        drive({}, 800, false);
        const RandomStream random(static_cast<std::uint64_t>(run), "drive");
        for (std::uint64_t leg = 0; leg < 12; ++leg)  // along a wall most of the time: the pen is 2.4 m wide
            drive({0.8 * random.uniform(leg, 0) + (leg % 3 ? 0.1 : -0.5), 2.4 * random.uniform(leg, 1) - 1.2},
                  1000, true);
        for (const auto& [what, depth] : pen.deepest) {
            INFO(what << " " << depth);
            CHECK(depth < 1e-3);
        }
        world.grip(0, false);
        drive({}, 400, false);
        drive({-0.5, 0}, 600, false);
        const Pose2 &r = world.pose(0), b = *world.movable_object_pose(0);
        CHECK(std::hypot(b.x - r.x, b.y - r.y) > 0.41);
    }
}
