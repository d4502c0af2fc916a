#include "core/run/robot_measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bug_interface/simulation/world_queries.h"
#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;
using test::description;
using test::make_world;

namespace {

WorldOptions without_noise() {
    WorldOptions out;
    out.noise = false;
    return out;
}

/// A world without noise, and what its first robot does.
struct Watched {
    std::unique_ptr<World> world;
    std::vector<RobotMeasure> measures;  // in the order of robot_quantities

    explicit Watched(const WorldDescription& from) : world(make_world(from, without_noise())) {
        Diagnostics diagnostics;
        for (const char* what : model::robot_quantities) {
            model::Measure wanted;
            wanted.what.text = what;
            if (auto m = RobotMeasure::make(wanted, world.get(), diagnostics)) measures.push_back(*m);
        }
        REQUIRE(measures.size() == 5);
    }
    void drive(double forward, int cycles) {
        for (int i = 0; i < cycles; ++i) {
            world->command(0, {forward, 0});
            world->step();
            for (auto& m : measures) m.after_cycle(*world);
        }
    }
    double path() const { return measures[0].value(*world); }
    double displacement() const { return measures[1].value(*world); }
    double collisions() const { return measures[2].value(*world); }
    double visits() const { return measures[3].value(*world); }
    double target_distance() const { return measures[4].value(*world); }
    void checkpoint(Archive& archive) {
        world->checkpoint(archive);
        for (auto& m : measures) m.checkpoint(archive);
    }
};

WorldDescription open_arena_from(double x, double y) {
    WorldDescription arena = description("open_arena");
    test::find_model(arena, "Bug")->pose = in_space({x, y, 0});
    return arena;
}

}  // namespace

TEST_CASE("A robot that drives forwards and back has a path, and is where it was") {
    Watched w(open_arena_from(0, 2));
    w.drive(0.5, 10);
    const double way = w.path();
    CHECK(way == Approx(5 * w.world->seconds_per_cycle()));
    CHECK(w.displacement() == Approx(way));
    w.drive(-0.5, 10);
    CHECK(w.path() == Approx(2 * way));
    CHECK(w.displacement() == Approx(0).margin(1e-9));
    CHECK(w.collisions() == 0);
    CHECK(w.visits() == 0);
}

TEST_CASE("A collision counts once while the robot pushes, and again after it was free") {
    Watched w(open_arena_from(4.5, 2));
    w.drive(1, 100);
    CHECK(w.collisions() == 1);
    CHECK(w.displacement() < 2);
    w.drive(-1, 5);
    CHECK(w.collisions() == 1);
    w.drive(1, 100);
    CHECK(w.collisions() == 2);
}

TEST_CASE("The visits of a target are counted in a world without trials, and checkpoints keep everything") {
    const Eigen::Vector2d target = make_world(description("open_arena"), {})->targets().front();
    const auto arena = open_arena_from(target.x(), target.y() > 0 ? target.y() - 0.2 : target.y() + 0.2);
    Watched w(arena);
    const int cycles = static_cast<int>(std::ceil(1 / w.world->seconds_per_cycle()));
    w.drive(-1, cycles);
    CHECK(w.visits() == 0);  // the robot began there
    w.drive(1, cycles);
    CHECK(w.visits() == 1);
    CHECK(w.target_distance() == Approx(0.2));
    Archive kept;
    w.checkpoint(kept);
    w.drive(-1, cycles), w.drive(1, cycles);
    CHECK(w.visits() == 2);

    Watched again(arena);
    Archive archive{std::string_view(kept.bytes())};
    again.checkpoint(archive);
    CHECK(again.visits() == 1);
    CHECK(again.target_distance() == w.target_distance());
    again.drive(-1, cycles), again.drive(1, cycles);
    CHECK(again.visits() == 2);
    CHECK(again.path() == w.path());
    CHECK(again.collisions() == w.collisions());
}

TEST_CASE("In a world with trials the numbers are sums over the trials, and resets do not count") {
    Watched w(description("basic_arena"));
    while (w.world->trials(0).size() < 4) w.drive(1, 1);
    double displacement = 0, reached = 0, nearest = 100;
    for (const Trial& t : w.world->trials(0)) {
        displacement += std::hypot(t.end.x - t.start.x, t.end.y - t.start.y);
        reached += t.reached_target;
        nearest = std::min(nearest, t.smallest_distance);
    }
    CHECK(displacement > 4 * 4);
    CHECK(w.displacement() == displacement);
    CHECK(w.path() == Approx(displacement));  // the trials are straight
    CHECK(w.visits() == reached);
    CHECK(w.target_distance() == nearest);
    CHECK(w.collisions() == 0);
    while (w.world->resetting(0)) w.drive(1, 1);
    w.drive(1, 5);
    CHECK(w.path() > displacement);
    CHECK(w.displacement() == Approx(w.path()));
}

TEST_CASE("The touch of another robot counts for both, and is noted only on demand") {
    WorldDescription arena = description("two_bugs");
    const auto noted = make_world(arena, {}), other = make_world(arena, {});
    noted->note_touches();
    bool both = false;
    for (int i = 0; i < 2000; ++i) {
        for (auto* world : {noted.get(), other.get()}) {
            const Pose2 a = world->pose(0), b = world->pose(1);
            const double turn =
                std::remainder(std::atan2(b.y - a.y, b.x - a.x) - a.yaw, 2 * std::numbers::pi);
            world->command(0, {std::abs(turn) < 0.2 ? 0.5 : 0.0, turn});
            world->step();
        }
        both = both || (noted->touched(0) && noted->touched(1));
        REQUIRE(noted->pose(0).x == other->pose(0).x);
        REQUIRE_FALSE(other->touched(0));
    }
    CHECK(both);
}
