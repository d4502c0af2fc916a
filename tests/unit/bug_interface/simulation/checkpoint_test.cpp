// Checkpoints of the physics and of worlds.
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "tests/unit/bug_interface/physics_step.h"
#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;

namespace {

constexpr std::size_t crowd_size = 7;
constexpr double inner_side = 1.4;  ///< m, inside; for seven robots of 0.4 m

std::vector<Obstacle> walls() {
    std::vector<Obstacle> out(5);
    for (std::size_t i = 0; i < 4; ++i) {
        Outline& o = out[i].outline;
        const double side = i % 2 ? -1 : 1, middle = side * (inner_side / 2 + 0.1);
        (i < 2 ? o.x : o.y) = middle;
        o.cos_yaw = 1, o.sin_yaw = 0;
        o.half_x = i < 2 ? 0.1 : inner_side / 2 + 0.2, o.half_y = i < 2 ? inner_side / 2 + 0.2 : 0.1;
    }
    out[4].outline.round = true, out[4].outline.radius = 0.1;
    return out;
}

/// Robots that push each other and the walls all the time.
class Crowd {
  public:
    Crowd() : physics_(walls(), std::vector<Body>(crowd_size), test::physics_step_s) {
        for (std::size_t i = 0; i < crowd_size; ++i)
            physics_.place(i, {-0.45 + 0.45 * static_cast<double>(i % 3),
                               -0.45 + 0.45 * static_cast<double>(i / 3), static_cast<double>(i)});
    }
    void step(std::uint64_t t) {
        std::mt19937 chance(static_cast<unsigned>(t / 100));  // the same commands at the same time t
        std::vector<MotorCommand> drives(crowd_size);
        for (auto& d : drives) {
            d.forward = static_cast<double>(chance() % 1000) / 500;
            d.turn = static_cast<double>(chance() % 1000) / 100 - 5;
        }
        test::step(physics_, drives);
    }
    std::string state() {
        Archive out;
        out(physics_);
        return out.bytes();
    }
    void restore(const std::string& state) {
        Archive in{std::string_view(state)};
        in(physics_);
    }
    std::uint64_t contact_steps() const { return physics_.contact_steps(); }

  private:
    Physics physics_;
};

}  // namespace

TEST_CASE("Robots that push each other continue from a checkpoint with the same bits") {
    Crowd through;
    std::uint64_t t = 0;
    for (int stop = 0; stop < 20; ++stop) {
        for (int i = 0; i < 317; ++i) through.step(t++);
        Crowd resumed;
        if (stop % 2)
            for (std::uint64_t other = 0; other < 200; ++other)
                resumed.step(10 * other);  // has had other contacts before
        resumed.restore(through.state());
        std::uint64_t later = t;
        for (int i = 0; i < 400; ++i) resumed.step(later++);
        Crowd beside;
        beside.restore(through.state());
        for (; t < later; ++t) through.step(t), beside.step(t);
        REQUIRE(resumed.state() == through.state());
        REQUIRE(beside.state() == through.state());
    }
    CHECK(through.contact_steps() > t / 2);
}

TEST_CASE("A world continues from a checkpoint of any cycle, in trials and resets, with pictures and noise") {
    WorldOptions options;
    options.seed = 5;
    const auto make = [&] {
        auto world = test::make_world(test::description("basic_arena"), options);
        world->request_image(0, true);
        return world;
    };
    const auto step = [](World& world) {
        const auto t = static_cast<double>(world.cycle());
        world.command(0, {3, std::sin(0.05 * t)});
        world.step();
    };
    const auto through = make();
    bool reset = false;
    while (through->trials(0).size() < 6) {
        step(*through);
        if (through->cycle() % 11) continue;
        reset |= through->resetting(0);
        Archive out;
        through->checkpoint(out);
        const auto resumed = make();
        Archive in{std::string_view(out.bytes())};
        resumed->checkpoint(in);
        REQUIRE(in.left().empty());
        for (int i = 0; i < 7; ++i) step(*through), step(*resumed);
        Archive one, other;
        through->checkpoint(one), resumed->checkpoint(other);
        REQUIRE(one.bytes() == other.bytes());
    }
    CHECK(reset);
}

TEST_CASE("Grippers that press against each other and the walls continue from a checkpoint of any cycle") {
    WorldDescription text = test::description("team_arena");
    text.game.reset();
    const Model robot = *test::find_model(text, "A_1");
    std::erase_if(text.models,
                  [](const Model& m) { return m.name.starts_with("A_") || m.name.starts_with("B_"); });
    for (int i = 0; i < 4; ++i) {  // in the corner of the arena
        text.models.push_back(robot);
        text.models.back().name = fmt::format("R{}", i);
        text.models.back().pose = in_space({5.3 + 0.9 * (i % 2), 5.3 + 0.9 * (i / 2), 0.8});
    }
    const auto through = test::make_world(text);
    const auto step = [](World& world) {
        std::mt19937 chance(static_cast<unsigned>(world.cycle() / 10));  // the same in every world
        for (std::size_t i = 0; i < 4; ++i) {
            const double forward = static_cast<double>(chance() % 1000) / 700 - 0.2,
                         turn = static_cast<double>(chance() % 1000) / 500 - 1;
            world.command(i, {forward, turn}), world.grip(i, chance() % 2);
        }
        world.step();
    };
    const auto state = [](World& world) {
        Archive out;
        world.checkpoint(out);
        return out.bytes();
    };
    for (int stop = 0; stop < 12; ++stop) {
        for (int i = 0; i < 23; ++i) step(*through);
        const auto resumed = test::make_world(text);
        if (stop % 2)
            for (int i = 0; i < 9; ++i) step(*resumed);  // has had other contacts before
        const std::string before = state(*through);
        Archive in{std::string_view(before)};
        resumed->checkpoint(in);
        for (int i = 0; i < 20; ++i) step(*through), step(*resumed);
        const bool same = state(*through) == state(*resumed);
        REQUIRE(same);
    }
    CHECK(through->physics().contact_steps() > 2 * through->cycle());
}
