// What does company cost? One robot and eight in the same arena, driven alike, with all senses.
//
//     bench_crowd
//
// They wander, meet walls and each other, open and close their grippers. Last result: see
// docs/design/performance.md.
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/types/random.h"
#include "tests/bench/report.h"

namespace {

using namespace forage;

/// The team arena, with this many robots in a ring.
std::unique_ptr<bug::World> arena(const bug::WorldDescription& read, int robots, Diagnostics& diagnostics) {
    bug::WorldDescription world = read;
    world.game.reset();
    bug::Model robot;
    for (const auto& m : world.models)
        if (m.name == "A_1") robot = m;
    std::erase_if(world.models,
                  [](const bug::Model& m) { return m.name.starts_with("A_") || m.name.starts_with("B_"); });
    for (int i = 0; i < robots; ++i) {
        const double angle = 2 * M_PI * i / 8;
        robot.name = fmt::format("R{}", i);
        robot.pose = bug::in_space({4 * std::cos(angle), 4 * std::sin(angle), angle});
        world.models.push_back(robot);
    }
    return bug::World::make(world, {}, diagnostics);
}

/// Microseconds per cycle; `contacts`: part of the substeps in which Bullet was called.
double measure(bug::World& world, double& contacts) {
    const RandomStream random(3, "drive");
    for (std::size_t i = 0; i < world.bugs(); ++i)
        world.need_image(i, true), world.need_gripper_scan(i, true);
    constexpr std::uint64_t cycles = 5000;
    const double begin = bench::thread_seconds();
    for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
        for (std::size_t i = 0; i < world.bugs(); ++i) {
            const auto n = static_cast<std::uint32_t>(3 * i);
            world.command(
                i, {1.4 * random.uniform(cycle / 25, n) - 0.2, 3 * random.uniform(cycle / 25, n + 1) - 1.5});
            world.grip(i, random.uniform(cycle / 100, n + 2) < 0.5);
        }
        world.step();
    }
    const double seconds = bench::thread_seconds() - begin;
    contacts = static_cast<double>(world.physics().contact_steps()) / static_cast<double>(world.substeps());
    return 1e6 * seconds / cycles;
}

}  // namespace

int main() {
    Diagnostics diagnostics;
    const auto read =
        bug::read_world(std::string(FORAGE_SOURCE_DIR) + "/systems/worlds/team_arena.world", diagnostics);
    double times[2] = {}, contacts[2] = {};
    for (const int n : {0, 1}) {
        auto world = read ? arena(*read, n ? 8 : 1, diagnostics) : nullptr;
        if (!world) {
            fmt::print(stderr, "{}", format(diagnostics));
            return 2;
        }
        times[n] = measure(*world, contacts[n]);
    }
    fmt::print("1 robot   {:7.1f} us per cycle of 40 ms, contacts looked for in {:.0f} % of the steps\n",
               times[0], 100 * contacts[0]);
    fmt::print("8 robots  {:7.1f} us per cycle of 40 ms, contacts looked for in {:.0f} % of the steps\n",
               times[1], 100 * contacts[1]);
    fmt::print("8 robots run at {:.3f} of the rate of one\n", times[0] / times[1]);
    bench::result("crowd", "rate of 8 robots / of one", times[0] / times[1], "");
}
