// The original's worlds, which are read from the original's folder, load, and their robots run in them with
// the original's systems.
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "bug_interface/module/gazebo_bug.h"
#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/base/random.h"
#include "core/engine/simulation.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
using namespace forage::test;

namespace {

using Path = std::filesystem::path;

std::vector<Path> files(const std::string& ending) {
    std::vector<Path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_dir() / "original"))
        if (entry.path().extension() == ending) out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

std::optional<bug::WorldDescription> read(const Path& file, Diagnostics& diagnostics) {
    return bug::read_world(file.string(), diagnostics, {(shared_dir() / "original" / "models").string()});
}

}  // namespace

TEST_CASE("Every world of the original loads, with its robots, movable objects and targets") {
    if (absent(shared_dir() / "original")) return;
    struct Content {
        std::size_t robots, movable_objects, targets;
        bool gripper, camera;
    };
    const std::map<std::string, Content> expected = {
        {"DAC_basic_arena", {1, 0, 1, false, true}},
        {"DAC_basic_ambiguous_arena", {1, 0, 1, false, true}},
        {"DAC_arena", {1, 0, 2, false, true}},
        {"DAC_basic_apprach_avoid_arena", {1, 0, 2, false, true}},
        {"DAC_approach_avoid_arena", {1, 0, 3, true, true}},
        {"SDIC_arena", {8, 0, 0, true, true}},
        {"SDIC_one_robot_arena", {1, 0, 0, true, true}},
        {"SDIC_debug_arena", {1, 0, 0, true, false}},
        {"SDIC_two_robot_arena", {2, 5, 0, true, true}},
        {"SDIC_competition", {8, 0, 0, true, true}},
        {"robot_iqr", {1, 0, 0, false, true}},
        {"follow_line", {1, 0, 0, false, true}}};
    std::set<std::string> found;
    for (const Path& file : files(".world")) {
        INFO(file);
        Diagnostics diagnostics;
        const auto description = read(file, diagnostics);
        INFO(format(diagnostics));
        REQUIRE(description);
        const auto world = bug::World::make(*description, {}, diagnostics);
        REQUIRE(world);
        REQUIRE(expected.contains(file.stem()));
        const Content& content = expected.at(file.stem());
        CHECK(world->bugs() == content.robots);
        CHECK(world->movable_objects() == content.movable_objects);
        CHECK(world->targets().size() == content.targets);
        for (std::size_t i = 0; i < world->bugs(); ++i) {
            CHECK(world->has_gripper(i) == content.gripper);
            CHECK((world->image(i).size() == 32 * 28 * 3) == content.camera);
        }
        found.insert(file.stem());
    }
    CHECK(found.size() == expected.size());
}

TEST_CASE("The gripper's rays see its own palm and fingers as in the original") {
    const auto file = shared_dir() / "original" / "SDIC_challenge" / "SDIC_one_robot_arena.world";
    if (absent(file)) return;
    Diagnostics diagnostics;
    const auto description = read(file, diagnostics);
    REQUIRE(description);
    bug::WorldOptions options;
    options.noise = false;
    const auto world = bug::World::make(*description, options, diagnostics);
    REQUIRE(world);
    world->request_gripper_scan(0, true);
    const auto sees = [&](const std::vector<double>& cells) {
        const auto& seen = world->snapshot(0).gripper;
        REQUIRE(seen.size() == 16);
        for (std::size_t k = 0; k < 8; ++k) {
            INFO(k);
            CHECK(seen[k] == Approx(cells[k]).margin(0.002));
            CHECK(seen[15 - k] == Approx(cells[k]).margin(0.002));
        }
    };
    const auto wait = [&] {
        for (int cycle = 0; cycle < 25; ++cycle) world->step();
    };
    sees({0.907, 0.213, 0.104, 0, 0, 0, 0, 0});
    world->grip(0, false), wait();
    sees({0.907, 0, 0, 0, 0, 0, 0, 0});
    world->grip(0, true), wait();
    sees({0.907, 0.760, 0.675, 0.479, 0.328, 0.292, 0.238, 0.159});
}

TEST_CASE("Robots driven at random in the original's worlds stay in them") {
    if (absent(shared_dir() / "original")) return;
    for (const Path& file : files(".world")) {
        INFO(file);
        Diagnostics diagnostics;
        const auto description = read(file, diagnostics);
        REQUIRE(description);
        const auto world = bug::World::make(*description, {}, diagnostics);
        REQUIRE(world);
        const RandomStream random(5, "drive");
        for (std::size_t i = 0; i < world->bugs(); ++i) world->request_gripper_scan(i, true);
        for (std::uint64_t cycle = 0; cycle < 1500; ++cycle) {
            for (std::size_t i = 0; i < world->bugs(); ++i) {
                const auto n = static_cast<std::uint32_t>(3 * i);
                world->command(i, {2 * random.uniform(cycle / 20, n) - 0.4,
                                   3 * random.uniform(cycle / 20, n + 1) - 1.5});
                world->grip(i, random.uniform(cycle / 40, n + 2) < 0.5);
            }
            world->step();
        }
        for (std::size_t i = 0; i < world->bugs(); ++i) {
            const auto& at = world->pose(i);
            INFO(at.x << " " << at.y);
            CHECK((std::abs(at.x) < 20 && std::abs(at.y) < 20));
            for (const double v : world->snapshot(i).proximity) CHECK((v >= 0 && v < 1));
        }
    }
}

TEST_CASE("The original's systems run in the original's worlds") {
    if (absent(shared_dir() / "original")) return;
    std::size_t ran = 0;
    for (const Path& system_file : files(".iqr"))
        for (const Path& world_file : files(".world")) {
            INFO(system_file << " in " << world_file);
            Diagnostics diagnostics;
            diagnostics.lenient = true;
            const auto system = xml::read_system(system_file.string(), diagnostics);
            const auto description = read(world_file, diagnostics);
            REQUIRE((system && description));
            bug::WorldOptions options;
            if (system->cycles_per_second > 0) options.cycles_per_second = system->cycles_per_second;
            const auto world = bug::World::make(*description, options, diagnostics);
            Registry registry;
            add_neurons(registry), add_synapses(registry), add_modules(registry);
            registry.add(bug::gazebo_bug_type());
            auto simulation = engine::Simulation::build(*system, registry, engine::Demand::everything(),
                                                        {.environment = world.get()}, diagnostics);
            if (!simulation) {  // the system needs a robot with another name
                CHECK(format(diagnostics).find("there is no robot '") != std::string::npos);
                continue;
            }
            simulation->start();
            for (int cycle = 0; cycle < 100; ++cycle) simulation->step(), world->step();
            ++ran;
        }
    CHECK(ran >= 20);
}
