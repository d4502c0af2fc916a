#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include <fmt/format.h>

#include "tools/forage/commands.h"
#include "tools/forage/files.h"
#include "tools/forage/length.h"
#include "tools/forage/pictures.h"
#include "tools/forage/progress.h"
#include "tools/forage/results.h"
#include "tools/forage/running.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

/// Runs until the end, or until something stops it. Throws what a cycle or a recording throws.
void loop(const RunOptions& o, Running& r, const Length& length, Progress& progress, Outcome& outcome) {
    auto& simulation = r.simulation;
    while (!length.over(simulation.cycle()) && !r.done()) {
        r.cycle();
        if (o.real_time)
            if (const double ahead = r.seconds() - progress.elapsed(); ahead > 0)
                std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
        if (progress.due())
            progress.draw({length.done(simulation.cycle()), simulation.cycle(), r.seconds(), length.text()});
        outcome.stopped = noted_signal() ? stopped_by(noted_signal()) : length.hopeless();
        if (!outcome.stopped.empty()) return;
    }
}

/// Writes what a run leaves behind; what cannot be written does not keep the rest from being written. Returns
/// what went wrong.
std::vector<std::string> write_results(const RunOptions& o, Running& r, Outcome& outcome) {
    const auto earlier = files_of_last_run(o.directory);
    auto problems = write_tables(o, r, outcome);
    for (auto& problem : write_pictures(o, r, outcome)) problems.push_back(std::move(problem));
    try {
        write_file(o.directory + "/run.json", run_json(o, r.loaded, outcome));
        outcome.files.emplace_back("run.json");
    } catch (const std::exception& e) {
        problems.emplace_back(e.what());
    }
    for (const auto& name : earlier)
        if (std::find(outcome.files.begin(), outcome.files.end(), name) == outcome.files.end())
            std::remove((o.directory + "/" + name).c_str());
    return problems;
}

}  // namespace

int run(const RunOptions& options) {
    Diagnostics diagnostics;
    if (!(options.recordings.empty() && options.plots.empty()) && options.directory.empty())
        diagnostics.error({}, "--record and --plot need a directory to write to",
                          "leave out -o '' or name one");
    auto running = prepare(read(options.input, diagnostics), options, diagnostics);
    if (diagnostics.failed() || !options.quiet) fmt::print(stderr, "{}", format(diagnostics));
    if (!running) return bad_input;

    note_signals();
    const Length length(options, running->loaded.world.get(), running->seconds_per_cycle);
    Progress progress(!options.quiet);
    Outcome outcome;
    outcome.length = length.cycles();
    std::vector<std::string> problems;
    try {
        loop(options, *running, length, progress, outcome);
    } catch (const std::exception& e) {
        outcome.stopped = e.what();
        problems.emplace_back(e.what());
    }
    if (running->film) try {
            outcome.frames = running->film->finish();
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }
    note(*running, outcome);
    outcome.clock = std::max(progress.elapsed(), 1e-9);
    progress.clear();

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
