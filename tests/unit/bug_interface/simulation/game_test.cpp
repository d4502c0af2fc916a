// The rules of the robotics challenge's game.
#include "bug_interface/simulation/game.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "tests/support/catch.h"
#include "tests/unit/bug_interface/physics_step.h"

using namespace forage;
using namespace forage::bug;
using test::physics_step_s;

namespace {

constexpr std::array<Pose2, 2> far_homes = {Pose2{-100, 100, 0}, Pose2{100, -100, 0}};

Body resource_body() {
    Body b;
    b.radius = 0.08, b.mass = 0.01, b.driven = false, b.deceleration = 0.98;
    return b;
}

/// Balls that no robot touches, and a game with them.
struct Table {
    Physics physics;
    Game game;
    double time = 0;

    Table(int balls, std::optional<GameRules> rules, std::array<Pose2, 2> homes = far_homes,
          std::uint64_t seed = 1)
        : physics({}, std::vector<Body>(static_cast<std::size_t>(balls), resource_body()), physics_step_s),
          game(std::move(rules), homes, resources(balls), seed) {
        for (int i = 0; i < balls; ++i) physics.place(static_cast<std::size_t>(i), start(i));
        game.begin(physics);
    }
    static Pose2 start(int i) { return {20.0 + i, 0, 0}; }
    static std::vector<Game::Resource> resources(int balls) {
        std::vector<Game::Resource> out;
        for (int i = 0; i < balls; ++i) out.push_back({static_cast<std::size_t>(i), start(i)});
        return out;
    }
    void run(int steps) {
        for (; steps > 0; --steps) game.advance(physics, time += physics_step_s, physics_step_s, 1);
    }
    /// Simulates seconds in steps of 1 s, which is fast; only for tests without contacts and homes.
    void seconds(int n) {
        for (; n > 0; --n) game.advance(physics, time += 1, 1, 1);
    }
    std::ptrdiff_t present() const {
        return std::count_if(game.resources().begin(), game.resources().end(),
                             [](const Game::Resource& r) { return !r.removed; });
    }
};

GameRules rules_of(std::vector<GameSite> sites) {
    GameRules rules;
    rules.sites = std::move(sites);
    return rules;
}

}  // namespace

TEST_CASE("Without rules a resource at a home counts and goes back to its start, every 101st step") {
    Table table(2, {}, {Pose2{-10, 10, 0}, Pose2{10, -10, 0}});
    table.physics.place(0, {-8, 8, 0});      // 2.83 m from A's
    table.physics.place(1, {7.8, -7.8, 0});  // 3.11 m from B's
    table.run(100);
    CHECK(table.game.deliveries().empty());
    table.run(1);
    REQUIRE(table.game.deliveries().size() == 1);
    CHECK(table.game.deliveries()[0].team == 0);
    CHECK(table.game.deliveries()[0].time == Approx(0.101));
    CHECK(table.physics.pose(0).x == Table::start(0).x);
    CHECK(table.physics.pose(1).x == 7.8);
    table.physics.place(0, {10, -9, 0});
    table.run(101);
    CHECK((table.game.points(0) == 1 && table.game.points(1) == 1));
    CHECK_FALSE(table.game.over());
}

TEST_CASE("Where homes overlap, a resource counts for B") {
    Table table(1, {}, {Pose2{0, 0, 0}, Pose2{1, 0, 0}});
    table.physics.place(0, {0.1, 0, 0});
    table.run(101);
    CHECK((table.game.points(0) == 0 && table.game.points(1) == 1));
}

TEST_CASE("A resource is good for 30 seconds, bad for 20 more, then disappears, and can appear again") {
    GameRules rules = rules_of({{0, 0, 1}});
    rules.most = 1, rules.duration = 1000;
    Table table(1, rules);
    const auto& r = table.game.resources()[0];
    CHECK(r.removed);
    for (int life = 0; life < 3; ++life) {
        table.seconds(1);  // it appears
        REQUIRE((!r.removed && r.good && r.age == 0));
        table.seconds(29);
        CHECK((r.good && r.age == 29));
        table.seconds(1);
        CHECK((!r.good && !r.removed));
        table.seconds(19);
        CHECK((!r.good && !r.removed && r.age == 49));
    }  // in the next second it dissolves, and the next one appears
}

TEST_CASE("A resource that counts scores 2, or -1 when it is bad, and may appear again") {
    for (const bool good : {true, false}) {
        GameRules rules = rules_of({{0, 0, 1}});
        rules.most = 1, rules.stale_after = good ? 30 : 1;
        Table table(1, rules, {Pose2{0, 0, 0}, Pose2{50, 50, 0}});
        table.seconds(1);
        table.seconds(1);  // it ages by one second
        table.run(101);
        REQUIRE(table.game.deliveries().size() == 1);
        CHECK(table.game.points(0) == (good ? 2 : -1));
        CHECK(table.game.resources()[0].removed);
        table.seconds(1);
        const auto& again = table.game.resources()[0];
        CHECK((!again.removed && again.good && again.age == 0));
    }
}

TEST_CASE("A resource that a robot holds does not age") {
    // Between two robots there are two contacts per step. One per step would be 101 between two checks, which
    // is just enough.
    GameRules rules = rules_of({{5, 0, 1}});
    rules.most = 1;
    Physics physics({}, std::vector<Body>{Body{}, Body{}, resource_body()}, physics_step_s);
    physics.place(0, {0, 0, 0}), physics.place(1, {0.56, 0, 3.14159});
    Game game(rules, far_homes, {{2, {9, 9, 0}}}, 1);
    game.begin(physics);
    std::array<MotorCommand, 3> drives{};
    double time = 0;
    const auto run = [&](int steps) {
        for (; steps > 0; --steps)
            test::step(physics, drives), game.advance(physics, time += physics_step_s, physics_step_s, 1);
    };
    run(1500);
    REQUIRE_FALSE(game.resources()[0].removed);
    physics.place(2, {0.28, 0, 0});
    drives[0] = drives[1] = {0.1, 0};
    run(200);
    CHECK(game.resources()[0].held);
    const int age = game.resources()[0].age;
    run(10000);
    CHECK(game.resources()[0].age == age);
    drives[0] = drives[1] = {-0.1, 0};
    run(3000);
    CHECK_FALSE(game.resources()[0].held);
    CHECK(game.resources()[0].age >= age + 2);
}

TEST_CASE("When the time is over, all resources are removed and the score stays") {
    GameRules rules = rules_of({{0, 0, 1}});
    rules.duration = 3;
    Table table(16, rules, {Pose2{0, 0, 0}, Pose2{50, 50, 0}});
    CHECK(table.game.left() == 3);
    table.run(2500);
    CHECK(table.game.left() == Approx(0.5));
    const int points = table.game.points(0);
    CHECK(points == 4);  // one after each full second
    table.run(500);
    CHECK((table.game.over() && table.game.left() == 0));
    CHECK(table.present() == 0);
    table.physics.place(0, {0, 0, 0});
    table.run(5000);
    CHECK(table.game.points(0) == points);
    CHECK(table.present() == 0);
}

TEST_CASE("Resources appear with the chance of their sites, within 0.5 m, uniformly over the radius") {
    GameRules rules = rules_of({{0, 0, 0.15}, {30, 0, 0.1}});
    rules.duration = 1e6, rules.dissolves_after = 1;  // each is there for one second
    Table table(16, rules);
    constexpr int n = 20000;
    std::map<bool, int> appeared;  // at the second site?
    double sum = 0, farthest = 0;
    for (int i = 0; i < n; ++i) {
        table.seconds(1);
        for (const Game::Resource& r : table.game.resources()) {
            if (r.removed) continue;
            const Pose2& at = table.physics.pose(r.body);
            const bool second = at.x > 15;
            const double radius = std::hypot(at.x - (second ? 30 : 0), at.y);
            ++appeared[second], sum += radius, farthest = std::max(farthest, radius);
        }
    }
    CHECK(appeared[false] == Approx(0.15 * n).margin(4 * std::sqrt(0.15 * 0.85 * n)));
    CHECK(appeared[true] == Approx(0.1 * n).margin(4 * std::sqrt(0.1 * 0.9 * n)));
    CHECK(sum / (appeared[false] + appeared[true]) == Approx(0.25).margin(0.01));
    CHECK((farthest > 0.49 && farthest <= 0.5));
}

TEST_CASE("There are never more resources than the rules permit") {
    GameRules rules = rules_of({{0, 0, 1}, {5, 0, 1}, {10, 0, 1}, {15, 0, 1}});
    Table table(rules.most, rules);
    CHECK(rules.most == 16);
    std::ptrdiff_t most = 0;
    for (int i = 0; i < 60; ++i) table.seconds(1), most = std::max(most, table.present());
    CHECK(most == 16);
}

TEST_CASE("The challenge's sites: one of the first four, one of the last three, and their reflections") {
    const std::array<std::pair<double, double>, 6> places = {
        {{-3, 3}, {0, 7.5}, {-6, 6}, {7.5, 4}, {10.5, 10.5}, {12, 4.5}}};
    const auto number = [&](const GameSite& site) {
        return std::find(places.begin(), places.end(), std::pair(site.x, site.y)) - places.begin();
    };
    std::map<std::ptrdiff_t, int> first, second;
    int first_rich = 0;
    constexpr int n = 6000;
    for (std::uint64_t seed = 0; seed < n; ++seed) {
        const auto sites = challenge_sites(RandomStream(seed, "game"));
        REQUIRE(sites.size() == 4);
        for (const std::size_t pair : {std::size_t{0}, std::size_t{2}}) {
            CHECK((sites[pair + 1].x == -sites[pair].x && sites[pair + 1].y == -sites[pair].y));
            CHECK(sites[pair + 1].chance == sites[pair].chance);
        }
        CHECK(std::set{sites[0].chance, sites[2].chance} == std::set{0.1, 0.15});
        ++first[number(sites[0])], ++second[number(sites[2])];
        first_rich += sites[0].chance == 0.15;
    }
    CHECK((first.size() == 4 && first.rbegin()->first == 3));
    CHECK((second.size() == 3 && second.begin()->first == 3 && second.rbegin()->first == 5));
    for (const auto& [place, count] : first) CHECK(count == Approx(n / 4.0).margin(140));
    for (const auto& [place, count] : second) CHECK(count == Approx(n / 3.0).margin(150));
    CHECK(first_rich == Approx(n / 2.0).margin(160));
}
