// How fast does a system drive the robot on one core, and where does the time go?
//
//     bench_closed_loop [SYSTEM.iqr WORLD.world [SETTING...]]
//
// Without arguments: the systems that ship, also in the open arena, where the robot ends up at a wall, and
// the tutorial's own where $FORAGE_SHARED is. They run as `forage run -o ''` runs them: groups that nobody
// reads are left out, among them the camera of the reactive systems. Then with everything updated. Last
// result: docs/design/performance.md.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
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
#include "tests/bench/report.h"
#include "tests/support/golden.h"
#include "tools/forage/layers.h"

namespace {

using namespace forage;
using Clock = std::chrono::steady_clock;

constexpr std::array<const char*, 6> parts = {"groups",  "modules", "connections",
                                              "physics", "rays",    "camera"};
constexpr int blocks = 20, cycles_per_block = 2000;

enum class Update { what_is_read, everything };

/// Prints what it measured; returns whether it could.
bool measure(const std::string& subject, const std::string& system_file, const std::string& world_file,
             const std::vector<std::string>& settings = {}, Update update = Update::what_is_read) {
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
    if (update == Update::what_is_read) {
        engine::Observed observed;
        tool::Layers(*simulation).note_observed(observed);  // for the measures of trials
        simulation->leave_out_unread(observed);
    }
    simulation->watch(true);
    simulation->start();

    // Whole cycles, without looking at the clock in between; then the same again, part by part.
    std::vector<double> whole;
    std::array<std::vector<double>, parts.size()> by_part;
    for (int b = 0; b < blocks; ++b) {
        const double begin = bench::thread_seconds();
        for (int i = 0; i < cycles_per_block; ++i) {
            simulation->step();
            world->step();
        }
        whole.push_back((bench::thread_seconds() - begin) / cycles_per_block);

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
    const double cycle = bench::median(whole);
    int left_out = 0;
    for (int g = 0; g < simulation->groups(); ++g) left_out += simulation->left_out(g);
    fmt::print("{}\n", subject);
    bench::result("closed loop/" + subject, "rate", 1 / cycle, "cycles/s");
    bench::result("closed loop/" + subject, "x real time", world->seconds_per_cycle() / cycle, "");
    fmt::print(
        "  {:.0f} cycles/s, {:.0f} x real time ({:g} ms of the world per cycle), {:.1f} us per cycle; median "
        "of {} blocks of {} cycles; {} of {} groups left out\n",
        1 / cycle, world->seconds_per_cycle() / cycle, 1000 * world->seconds_per_cycle(), 1e6 * cycle, blocks,
        cycles_per_block, left_out, simulation->groups());
    for (std::size_t p = 0; p < parts.size(); ++p) {
        fmt::print("  {:<12} {:6.2f} us\n", parts[p], 1e6 * bench::median(by_part[p]));
        bench::result("closed loop/" + subject, parts[p], 1e6 * bench::median(by_part[p]), "us/cycle");
    }
    return true;
}

/// As `forage run` runs it, and with everything updated.
bool measure_both(const std::string& subject, const std::string& system, const std::string& world,
                  const std::vector<std::string>& settings = {}) {
    return measure(subject, system, world, settings) &&
           measure(subject + ", everything updated", system, world, settings, Update::everything);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2)
        return measure_both(fmt::format("{} in {}", argv[1], argv[2]), argv[1], argv[2],
                            {argv + 3, argv + argc})
                   ? 0
                   : 2;
    const std::string own = std::string(FORAGE_SOURCE_DIR) + "/systems/", worlds = own + "worlds/";
    const std::string original = (test::shared_dir() / "original" / "DAC_files").string() + "/";
    const std::vector<std::string> contextual = {"Contextual.enableModule=true"};
    bool good =
        measure_both("reactive_foraging in basic_arena", own + "reactive_foraging.iqr",
                     worlds + "basic_arena.world") &&
        measure("reactive_foraging in open_arena", own + "reactive_foraging.iqr",
                worlds + "open_arena.world") &&
        measure_both("dac_foraging in basic_arena", own + "dac_foraging.iqr", worlds + "basic_arena.world");
    if (!std::filesystem::exists(original)) {
        fmt::print("skipped: the tutorial's own systems, there is no {}\n", original);
        return good ? 0 : 2;
    }
    const std::string arena = original + "DAC_basic_arena.world";
    good = good && measure_both("DACReactiveBug", original + "DACReactiveBug.iqr", arena) &&
           measure_both("DACBugBasicArena", original + "DACBugBasicArena.iqr", arena) &&
           measure_both("DACBugBasicArena with its contextual layer", original + "DACBugBasicArena.iqr",
                        arena, contextual);
    return good ? 0 : 2;
}
