#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "core/engine/simulation.h"
#include "tools/forage/commands.h"
#include "tools/forage/files.h"
#include "tools/forage/length.h"
#include "tools/forage/measures.h"
#include "tools/forage/paths.h"
#include "tools/forage/progress.h"
#include "tools/forage/recordings.h"
#include "tools/forage/results.h"
#include "tools/forage/schedule.h"
#include "tools/forage/stop.h"
#include "tools/forage/tables.h"
#include "tools/plot/trajectory.h"

namespace forage::tool {
namespace {

/// A system that has started, with all that looks at it and pokes it.
struct Running {
    Loaded loaded;
    engine::Simulation simulation;
    observe::Schedule schedule;
    observe::Clamp clamp;
    std::optional<Recordings> recordings;  ///< none without a directory
    std::vector<Measures> measures;        ///< one per robot
    std::vector<PathLog> paths;            ///< one per robot, when there is a directory
};

/// Reads, checks and starts everything. Whatever is wrong with what a person gave is found here, before the
/// first cycle and before anything is written.
std::optional<Running> prepare(const RunOptions& o, Diagnostics& diagnostics) {
    auto loaded = load(o.input, diagnostics);
    if (!loaded) return std::nullopt;
    check_length(o, loaded->world.get(), diagnostics);
    if (loaded->drive) check_drive(*loaded->drive, loaded->system, diagnostics);
    auto simulation = engine::Simulation::build(loaded->system, loaded->registry,
                                                {.seed = o.input.seed, .threads = o.threads}, diagnostics);
    if (!simulation) return std::nullopt;
    auto scheduled = schedule(o.at, *loaded, *simulation, diagnostics);
    auto clamped = clamp(o.clamp, *simulation, diagnostics);
    auto columns = recorded_columns(o.recordings, *simulation, diagnostics);
    if (!columns.empty() && o.directory.empty())
        diagnostics.error({}, "--record needs a directory to write to", "leave out -o '' or name one");
    if (diagnostics.failed()) return std::nullopt;
    try {
        simulation->start();
        Running out{std::move(*loaded),
                    std::move(*simulation),
                    std::move(scheduled),
                    std::move(clamped),
                    std::nullopt,
                    {},
                    {}};
        if (out.loaded.world)
            for (std::size_t i = 0; i < out.loaded.world->bugs(); ++i)
                out.measures.emplace_back(*out.loaded.world, i, out.simulation);
        if (!o.directory.empty()) {
            make_directory(o.directory);
            out.recordings.emplace(std::move(columns), o.every, o.directory, out.simulation);
            if (out.loaded.world)
                for (std::size_t i = 0; i < out.loaded.world->bugs(); ++i)
                    out.paths.emplace_back(*out.loaded.world, i);
        }
        return out;
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        return std::nullopt;
    }
}

/// One pass of the loop is one cycle: the system, then its world. Throws what a cycle or a recording throws.
void loop(const RunOptions& o, Running& r, const Length& length, double seconds_per_cycle, Progress& progress,
          Outcome& outcome) {
    auto& simulation = r.simulation;
    while (!length.over(simulation.cycle())) {
        if (r.schedule.waiting())
            r.schedule.apply(simulation, moment(r.loaded, simulation, seconds_per_cycle));
        simulation.update_groups();
        r.clamp.apply(simulation);
        simulation.update_modules();
        simulation.update_connections();
        if (r.loaded.world) r.loaded.world->step();
        if (r.recordings) r.recordings->record(simulation);
        for (auto& m : r.measures) m.follow(simulation);
        for (auto& p : r.paths) p.follow();

        const double seconds = static_cast<double>(simulation.cycle()) * seconds_per_cycle;
        if (o.real_time)
            if (const double ahead = seconds - progress.elapsed(); ahead > 0)
                std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
        if (progress.due())
            progress.draw({length.done(simulation.cycle()), simulation.cycle(), seconds, length.text()});
        outcome.stopped = noted_signal() ? stopped_by(noted_signal()) : length.hopeless();
        if (!outcome.stopped.empty()) return;
    }
}

/// Writes what a run leaves behind; what cannot be written does not keep the rest from being written. Returns
/// what went wrong.
std::vector<std::string> write_results(const RunOptions& o, Running& r, Outcome& outcome) {
    std::vector<std::string> problems;
    const auto attempt = [&](const std::string& name, auto write) {
        try {
            write(o.directory + "/" + name);
            outcome.files.push_back(name);
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }
    };
    const auto earlier = files_of_last_run(o.directory);
    if (const std::string problem = r.recordings->finish(); !problem.empty()) problems.push_back(problem);
    outcome.files = r.recordings->files();
    const auto& world = r.loaded.world;
    for (std::size_t i = 0; i < r.paths.size(); ++i) {
        const std::string robot = r.paths.size() > 1 ? "_" + file_name(world->bug_names()[i]) : "";
        attempt("trials" + robot + ".csv",
                [&](const std::string& path) { write_file(path, trials_csv(outcome.trials[i])); });
        attempt("trajectory" + robot + ".csv",
                [&](const std::string& path) { write_file(path, r.paths[i].csv()); });
        attempt("trajectory" + robot + ".png", [&](const std::string& path) {
            plot::draw_trajectory(*world, r.paths[i].paths(), picture_title(o, r.loaded), partial(path));
            finish(path);
        });
    }
    attempt("run.json", [&](const std::string& path) { write_file(path, run_json(o, r.loaded, outcome)); });
    for (const auto& name : earlier)
        if (std::find(outcome.files.begin(), outcome.files.end(), name) == outcome.files.end())
            std::remove((o.directory + "/" + name).c_str());
    return problems;
}

}  // namespace

int run(const RunOptions& options) {
    Diagnostics diagnostics;
    auto running = prepare(options, diagnostics);
    if (diagnostics.failed() || !options.quiet) fmt::print(stderr, "{}", format(diagnostics));
    if (!running) return bad_input;

    note_signals();
    const auto* world = running->loaded.world.get();
    const double seconds_per_cycle =
        world ? world->seconds_per_cycle() : 1 / cycles_per_second(running->loaded.system);
    const Length length(options, world, seconds_per_cycle);
    Progress progress(!options.quiet);
    Outcome outcome;
    outcome.length = length.cycles();
    std::vector<std::string> problems;
    try {
        loop(options, *running, length, seconds_per_cycle, progress, outcome);
    } catch (const std::exception& e) {
        outcome.stopped = e.what();
        problems.emplace_back(e.what());
    }
    outcome.cycles = running->simulation.cycle();
    outcome.seconds = static_cast<double>(outcome.cycles) * seconds_per_cycle;
    for (const auto& e : running->schedule.entries()) outcome.changes.push_back({e.text, e.cycle});
    outcome.clock = std::max(progress.elapsed(), 1e-9);
    progress.clear();
    for (std::size_t i = 0; i < running->measures.size(); ++i)
        outcome.trials.push_back(trials_of(*world, i, running->measures[i], running->simulation));

    if (!options.directory.empty())
        for (auto& problem : write_results(options, *running, outcome))
            if (std::find(problems.begin(), problems.end(), problem) == problems.end())
                problems.push_back(std::move(problem));
    if (!options.quiet) fmt::print("{}", summary(options, running->loaded, outcome));
    for (const auto& problem : problems) fmt::print(stderr, "error: {}\n", problem);
    if (!problems.empty()) return run_failed;
    return noted_signal() ? 128 + noted_signal() : fine;
}

}  // namespace forage::tool
