// Bodies and obstacles with many shapes and heights.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;
using test::description;

namespace {

constexpr int piece_count = 40;

Collision box_collision(double x, double y, double low, double high, double side_x, double side_y,
                        double yaw = 0) {
    Collision out;
    out.name = "c";
    out.pose.translation() = Eigen::Vector3d(x, y, (low + high) / 2);
    out.pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    out.shape = {ShapeKind::box, {side_x, side_y, high - low}};
    out.friction = 0.1;
    return out;
}

Model model_of(const std::string& name, bool is_static, std::vector<Collision> shapes) {
    Model out;
    out.name = name, out.is_static = is_static;
    Link link;
    link.name = "body", link.mass = 0.5, link.inertia_z = 0.01, link.collisions = std::move(shapes);
    out.links.push_back(std::move(link));
    return out;
}

/// The team arena with its first robot at the origin and with `models` added.
WorldDescription team_arena_with(std::vector<Model> models) {
    WorldDescription text = description("team_arena");
    text.game.reset();
    std::erase_if(text.models, [](const Model& m) { return m.name != "A_1"; });
    text.models.front().pose = in_space({0, 0, 0});
    for (Model& m : models) text.models.push_back(std::move(m));
    return text;
}

std::unique_ptr<World> made(const WorldDescription& text) {
    WorldOptions options;
    options.noise = false;
    return test::make_world(text, options);
}

void drive(World& world, MotorCommand command, int cycles) {
    world.command(0, command);
    for (int i = 0; i < cycles; ++i) world.step();
}

}  // namespace

TEST_CASE(
    "A wall of 40 pieces with 40 heights stops a robot everywhere, and is sensed where it is high enough") {
    // A ring of radius 1.2 m around the robot; piece i is 0.11 m high, and 0.005 m more than the one before.
    std::vector<Collision> pieces;
    for (int i = 0; i < piece_count; ++i) {
        const double at = 2 * std::numbers::pi * (i + 0.5) / piece_count;
        pieces.push_back(
            box_collision(1.2 * std::cos(at), 1.2 * std::sin(at), 0, 0.11 + 0.005 * i, 0.1, 0.2, at));
    }
    const WorldDescription text = team_arena_with({model_of("Ring", true, pieces)});
    for (int i = 0; i < piece_count; ++i) {
        WorldDescription turned = text;
        const double at = 2 * std::numbers::pi * (i + 0.5) / piece_count;
        turned.models.front().pose = in_space({0, 0, at});
        turned.models.front().models.clear();  // the gripper
        turned.models.front().hinges.clear();
        const auto world = made(turned);
        INFO("piece " << i);
        // The two rays nearest to straight ahead end 5.5 degrees aside, on this piece or the next one.
        const bool high = 0.11 + 0.005 * (i - 1) > 0.176, low = 0.11 + 0.005 * (i + 1) < 0.174;
        const double seen = world->snapshot(0).proximity[15];
        if (high && i + 1 < piece_count) CHECK(seen == Approx((2 - 1.15) / 2).margin(0.01));
        if (low && i > 0) CHECK(seen == 0);
        drive(*world, {1, 0}, 50);
        CHECK(std::hypot(world->pose(0).x, world->pose(0).y) == Approx(1.15 - 0.2).margin(0.002));
    }
}

TEST_CASE("A crate of 40 shapes is pushed and sensed like a crate of one shape") {
    std::vector<Collision> slices;
    for (int i = 0; i < piece_count; ++i)
        slices.push_back(
            box_collision(0, -0.2 + 0.4 * (i + 0.5) / piece_count, 0, 0.25, 0.3, 0.4 / piece_count));
    const auto crate = [&](std::vector<Collision> shapes) {
        Model m = model_of("Crate", false, std::move(shapes));
        m.pose = in_space({0.8, 0.05, 0});
        return m;
    };
    const auto sliced = made(team_arena_with({crate(slices)})),
               whole = made(team_arena_with({crate({box_collision(0, 0, 0, 0.25, 0.3, 0.4)})}));
    REQUIRE(sliced->movable_objects() == 1);
    for (int part = 0; part < 6; ++part) {
        CHECK(sliced->snapshot(0).proximity == whole->snapshot(0).proximity);
        if (part == 2) break;  // after a contact, the order of the solver has an effect
        drive(*sliced, {0.5, 0}, 5), drive(*whole, {0.5, 0}, 5);
    }
    drive(*sliced, {0.5, 0}, 60), drive(*whole, {0.5, 0}, 60);
    CHECK(sliced->movable_object_pose(0)->x > 1.2);
    CHECK(sliced->movable_object_pose(0)->x == Approx(whole->movable_object_pose(0)->x).margin(0.03));
    CHECK(sliced->movable_object_pose(0)->y == Approx(whole->movable_object_pose(0)->y).margin(0.03));
}

TEST_CASE("A gripper whose fingers have 40 shapes each closes and holds like one of single shapes") {
    Model ball;
    {
        Collision c;
        c.shape = {ShapeKind::sphere, Eigen::Vector3d::Constant(0.16)}, c.friction = 0.1;
        c.pose.translation().z() = 0.06;
        ball = model_of("Ball", false, {c});
        ball.links.front().mass = 0.01, ball.links.front().inertia_z = 1;
        ball.pose = in_space({0.33, 0.01, 0});
    }
    const WorldDescription plain = team_arena_with({ball});
    WorldDescription sliced = plain;
    std::size_t shapes = 0;
    const auto slice = [&](auto&& self, Model& model) -> void {
        for (Link& link : model.links) {
            if (!link.name.ends_with("finger") && !link.name.ends_with("tip")) continue;
            REQUIRE(link.collisions.size() == 1);
            const Collision whole = link.collisions.front();
            link.collisions.clear();
            for (int i = 0; i < piece_count; ++i) {
                Collision c = whole;
                c.shape.size.x() /= piece_count;
                c.pose.translation().x() += whole.shape.size.x() * ((i + 0.5) / piece_count - 0.5);
                link.collisions.push_back(c), ++shapes;
            }
        }
        for (Model& inner : model.models) self(self, inner);
    };
    slice(slice, sliced.models.front());
    REQUIRE(shapes == 4 * piece_count);
    const auto a = made(plain), b = made(sliced);
    for (World* world : {a.get(), b.get()}) {
        world->grip(0, false);
        drive(*world, {}, 10);
        world->grip(0, true);
        drive(*world, {}, 20);
        drive(*world, {0.5, 0.5}, 50);
        CHECK(world->gripper_angle(0, 0) < 0.44);  // the ball is between the fingers
        const Pose2 &r = world->pose(0), at = *world->movable_object_pose(0);
        const Eigen::Vector2d seen = Eigen::Rotation2Dd(-r.yaw) * Eigen::Vector2d(at.x - r.x, at.y - r.y);
        INFO(seen.x() << " " << seen.y());
        CHECK((seen.x() > 0.25 && seen.x() < 0.4 && std::abs(seen.y()) < 0.06));
    }
    for (std::size_t hinge = 0; hinge < 4; ++hinge)
        CHECK(a->gripper_angle(0, hinge) == Approx(b->gripper_angle(0, hinge)).margin(0.02));
}

TEST_CASE("A robot with too many heights gives one error, at the shape") {
    WorldDescription text = team_arena_with({});
    Link& body = *std::find_if(text.models.front().links.begin(), text.models.front().links.end(),
                               [](const Link& l) { return l.name == "bug"; });
    for (int i = 0; i < piece_count; ++i) {
        body.collisions.push_back(box_collision(0.15, 0, 0, 0.05 + 0.002 * i, 0.05, 0.05));
        body.collisions.back().where = {nullptr, 100 + i, 3};
    }
    Diagnostics diagnostics;
    CHECK_FALSE(World::make(text, {}, diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    const Diagnostic& d = diagnostics.all().front();
    CHECK(d.where.line > 120);
    CHECK_THAT(d.message, ContainsSubstring("more than 32 different ranges of heights"));
}
