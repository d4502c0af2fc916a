// How fast does a system drive the robot on one core, and where does the time go?
//
//     bench_closed_loop [SYSTEM.iqr WORLD.world [SETTING...]]
//
// Without arguments: the reactive system in the basic arena, where it drives and sees but touches nothing,
// and in the open one, where it ends up at a wall. Last result: see README.md.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#include "bug_interface/module/gazebo_bug.h"
#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/engine/simulation.h"
#include "core/model/edit.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"

namespace {

using namespace forage;
using Clock = std::chrono::steady_clock;

constexpr std::array<const char*, 6> parts = {"groups",  "modules", "connections",
                                              "physics", "rays",    "camera"};
constexpr int blocks = 20, cycles_per_block = 2000;

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

/// Prints what it measured; returns whether it could.
bool measure(const std::string& system_file, const std::string& world_file,
             const std::vector<std::string>& settings = {}) {
    Diagnostics diagnostics;
    diagnostics.lenient = true;
    auto system = xml::read_system(system_file, diagnostics);
    const auto description = bug::read_world(world_file, diagnostics);
    std::unique_ptr<bug::World> world;
    std::optional<engine::Simulation> simulation;
    Registry registry;
    if (system && description) {
        bug::WorldOptions options;
        if (system->cycles_per_second > 0) options.cycles_per_second = system->cycles_per_second;
        world = bug::World::make(*description, options, diagnostics);
        add_neurons(registry);
        add_synapses(registry);
        add_modules(registry);
        registry.add(bug::gazebo_bug_type(world.get()));
        for (const auto& setting : settings) model::set(*system, registry, setting, diagnostics);
        if (world) simulation = engine::Simulation::build(*system, registry, {}, diagnostics);
    }
    if (!simulation) {
        fmt::print(stderr, "{}", format(diagnostics));
        return false;
    }
    simulation->start();

    // Whole cycles, without looking at the clock in between; then the same again, part by part.
    std::vector<double> whole;
    std::array<std::vector<double>, parts.size()> by_part;
    for (int b = 0; b < blocks; ++b) {
        const auto begin = Clock::now();
        for (int i = 0; i < cycles_per_block; ++i) {
            simulation->step();
            world->step();
        }
        whole.push_back(std::chrono::duration<double>(Clock::now() - begin).count() / cycles_per_block);

        std::array<double, parts.size()> sums{};
        for (int i = 0; i < cycles_per_block; ++i) {
            auto at = Clock::now();
            const auto lap = [&](std::size_t part) {
                const auto now = Clock::now();
                sums[part] += std::chrono::duration<double>(now - at).count();
                at = now;
            };
            simulation->update_groups(), lap(0);
            simulation->update_modules(), lap(1);
            simulation->update_connections(), lap(2);
            world->advance_bodies(), lap(3);
            world->scan(), lap(4);
            world->render(), lap(5);
        }
        for (std::size_t p = 0; p < parts.size(); ++p) by_part[p].push_back(sums[p] / cycles_per_block);
    }
    const double cycle = median(whole);
    fmt::print("{} in {}\n", system_file, world_file);
    fmt::print(
        "  {:.0f} cycles/s, {:.0f} x real time ({:g} ms of the world per cycle), {:.1f} us per cycle; median "
        "of {} blocks of {} cycles\n",
        1 / cycle, world->seconds_per_cycle() / cycle, 1000 * world->seconds_per_cycle(), 1e6 * cycle, blocks,
        cycles_per_block);
    for (std::size_t p = 0; p < parts.size(); ++p)
        fmt::print("  {:<12} {:6.2f} us\n", parts[p], 1e6 * median(by_part[p]));
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2) return measure(argv[1], argv[2], {argv + 3, argv + argc}) ? 0 : 2;
    const std::string systems = std::string(FORAGE_SOURCE_DIR) + "/systems/";
    for (const char* world : {"basic_arena", "open_arena"})
        if (!measure(systems + "reactive_foraging.iqr", systems + "worlds/" + world + ".world")) return 2;
    return 0;
}
