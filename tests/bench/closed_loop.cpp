// How fast does a system drive the robot on one core, and where does the time go?
//
//     bench_closed_loop [SYSTEM.iqr WORLD.world [SETTING...]]
//
// Without arguments it runs the shipped systems, also in the open arena, where the robot ends at a wall, and
// the tutorial's own system if $FORAGE_SHARED is set. They run as `forage run -o ''` does, with pruning (the
// camera of the reactive systems, for example), and then with everything updated. A run is repeated, and each
// block of cycles counts with its fastest repetition; the figure is the median over blocks. Parts are
// measured apart from the whole. Last result: docs/design/performance.md.
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
#include "core/run/layers.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/report.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

namespace {

using namespace forage;
using Clock = std::chrono::steady_clock;

constexpr std::array<const char*, 6> parts = {"groups",  "modules", "connections",
                                              "physics", "rays",    "camera"};
constexpr int repetitions = 3, blocks = 20, cycles_per_block = 2000;

enum class Update { what_is_read, everything };

struct Case {
    std::string subject, system, world;
    std::vector<std::string> settings = {};
    Update update = Update::what_is_read;
};

/// The robot, its world and the system that drives it, ready to run.
struct Loop {
    Registry registry;
    std::unique_ptr<bug::World> world;
    std::optional<engine::Simulation> simulation;  ///< empty when `diagnostics` has errors
    Diagnostics diagnostics;

    explicit Loop(const Case& c) {
        diagnostics.lenient = true;
        auto system = xml::read_system(c.system, diagnostics);
        const auto description = bug::read_world(c.world, diagnostics);
        if (!system || !description) return;
        bug::WorldOptions options;
        if (system->cycles_per_second > 0) options.cycles_per_second = system->cycles_per_second;
        world = bug::World::make(*description, options, diagnostics);
        add_neurons(registry);
        add_synapses(registry);
        add_modules(registry);
        registry.add(bug::gazebo_bug_type());
        for (const auto& setting : c.settings) model::set(*system, registry, setting, diagnostics);
        if (!world) return;
        auto layout = engine::make_layout(*system, registry, diagnostics, world.get());
        if (!layout) return;
        engine::Demand demand = engine::Demand::everything();
        if (c.update == Update::what_is_read) {
            demand = {};
            Layers(*layout).declare(demand);  // for the measures of trials
        }
        simulation = engine::Simulation::build(*system, std::move(*layout), demand,
                                               {.environment = world.get()}, diagnostics);
        if (!simulation) return;
        simulation->check_finite(true);
        simulation->start();
    }
};

/// Time per cycle, s.
struct Times {
    double whole = 0;
    std::array<double, parts.size()> by_part{};
};

/// Measures whole cycles, without reading the clock between them, and then as many cycles part by part.
Times run_block(Loop& loop) {
    auto& simulation = *loop.simulation;
    auto& world = *loop.world;
    Times out;
    const double begin = bench::thread_seconds();
    for (int i = 0; i < cycles_per_block; ++i) {
        simulation.step();
        world.step();
    }
    out.whole = (bench::thread_seconds() - begin) / cycles_per_block;

    for (int i = 0; i < cycles_per_block; ++i) {
        auto at = Clock::now();
        const auto lap = [&](std::size_t part) {
            const auto now = Clock::now();
            out.by_part[part] += std::chrono::duration<double>(now - at).count() / cycles_per_block;
            at = now;
        };
        simulation.update_groups(), lap(0);
        simulation.update_modules(), lap(1);
        simulation.update_connections(), lap(2);
        world.advance_bodies(), lap(3);
        world.scan(), lap(4);
        world.render(), lap(5);
    }
    return out;
}

/// The shorter of two measurements of the same work.
Times least(const Times& a, const Times& b) {
    Times out{std::min(a.whole, b.whole), {}};
    for (std::size_t p = 0; p < parts.size(); ++p) out.by_part[p] = std::min(a.by_part[p], b.by_part[p]);
    return out;
}

template <class Of>
double median_of(const std::vector<Times>& times, Of of) {
    std::vector<double> out;
    for (const auto& t : times) out.push_back(of(t));
    return bench::median(out);
}

/// Measures a system and prints the result. Returns whether that was possible. A run does the same work in
/// every repetition, so the shortest time of each block counts: other load on the machine rarely slows the
/// same block in all repetitions.
bool measure(const Case& c) {
    std::vector<Times> best, all;
    int pruned = 0, groups = 0;
    double seconds_per_cycle = 0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        Loop loop(c);
        if (!loop.simulation) {
            fmt::print(stderr, "{}", format(loop.diagnostics));
            return false;
        }
        for (std::size_t b = 0; b < blocks; ++b) {
            const Times times = run_block(loop);
            all.push_back(times);
            if (repetition == 0)
                best.push_back(times);
            else
                best[b] = least(best[b], times);
        }
        seconds_per_cycle = loop.world->seconds_per_cycle();
        groups = static_cast<int>(loop.simulation->layout().groups.size());
        pruned = 0;
        for (int g = 0; g < groups; ++g) pruned += loop.simulation->pruned(g);
    }
    const auto whole = [](const Times& t) { return t.whole; };
    const double cycle = median_of(best, whole), usual = median_of(all, whole);
    const std::string subject = "closed loop/" + c.subject;
    fmt::print(
        "{}\n  {:.0f} cycles/s, {:.0f} x real time ({:g} ms of the world per cycle; {:.0f} x without "
        "choosing "
        "the best of {} repetitions), {:.1f} us per cycle; median of {} blocks of {} cycles; {} of {} groups "
        "left out\n",
        c.subject, 1 / cycle, seconds_per_cycle / cycle, 1000 * seconds_per_cycle, seconds_per_cycle / usual,
        repetitions, 1e6 * cycle, blocks, cycles_per_block, pruned, groups);
    bench::result(subject, "rate", 1 / cycle, "cycles/s");
    bench::result(subject, "x real time", seconds_per_cycle / cycle, "");
    bench::result(subject, "x real time, without choosing", seconds_per_cycle / usual, "");
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const double part = 1e6 * median_of(best, [p](const Times& t) { return t.by_part[p]; });
        fmt::print("  {:<12} {:6.2f} us\n", parts[p], part);
        bench::result(subject, parts[p], part, "us/cycle");
    }
    std::fflush(stdout);
    return true;
}

/// Measures a system as `forage run` runs it, and with everything updated.
bool measure_both(Case c) {
    if (!measure(c)) return false;
    c.subject += ", everything updated";
    c.update = Update::everything;
    return measure(c);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2)
        return measure_both(
                   {fmt::format("{} in {}", argv[1], argv[2]), argv[1], argv[2], {argv + 3, argv + argc}})
                   ? 0
                   : 2;
    const std::string own = std::string(FORAGE_SOURCE_DIR) + "/systems/", worlds = own + "worlds/";
    const std::string original = (test::shared_dir() / "original" / "DAC_files").string() + "/";
    const std::string reactive = own + "reactive_foraging.iqr", dac = own + "dac_foraging.iqr";
    bool good = measure_both({"reactive_foraging in basic_arena", reactive, worlds + "basic_arena.world"}) &&
                measure({"reactive_foraging in open_arena", reactive, worlds + "open_arena.world"}) &&
                measure_both({"dac_foraging in basic_arena", dac, worlds + "basic_arena.world"});
    if (!std::filesystem::exists(original)) {
        fmt::print("skipped: the tutorial's own systems, there is no {}\n", original);
        return good ? 0 : 2;
    }
    const std::string arena = original + "DAC_basic_arena.world", bug = original + "DACBugBasicArena.iqr";
    good = good && measure_both({"DACReactiveBug", original + "DACReactiveBug.iqr", arena}) &&
           measure_both({"DACBugBasicArena", bug, arena}) &&
           measure_both(
               {"DACBugBasicArena with its contextual layer", bug, arena, {"Contextual.enableModule=true"}});
    return good ? 0 : 2;
}
