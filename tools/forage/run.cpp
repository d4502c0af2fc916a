#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "tools/forage/checkpoint.h"
#include "tools/forage/checkpoint_file.h"
#include "tools/forage/commands.h"
#include "tools/forage/files.h"
#include "tools/forage/length.h"
#include "tools/forage/pictures.h"
#include "tools/forage/progress.h"
#include "tools/forage/result_names.h"
#include "tools/forage/results.h"
#include "tools/forage/running.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

/// Notices, once a second, that the directory for results is not there any more: what is written into open
/// files would be lost.
class Watch {
  public:
    explicit Watch(std::string directory) : directory_(std::move(directory)) {}
    bool gone() const { return !directory_.empty() && access(directory_.c_str(), F_OK) != 0; }
    std::string current_exception_message() const { return fmt::format("the directory '{}' is not there any more", directory_); }
    void look() {
        const auto now = std::chrono::steady_clock::now();
        if (now < next_) return;
        next_ = now + std::chrono::seconds(1);
        if (gone()) throw std::runtime_error(current_exception_message());
    }

  private:
    std::string directory_;
    std::chrono::steady_clock::time_point next_;
};

/// Runs until the end, or until something stops it. Throws what a cycle or a recording throws.
void loop(const RunOptions& o, Running& r, const Length& length, Checkpoints& checkpoints, Watch& watch,
          Progress& progress, Outcome& outcome) {
    auto& simulation = r.simulation;
    const double begun = r.seconds();
    bool told = !r.diverged.empty();  // before the run went on
    while (!length.over(simulation.cycle()) && !r.done()) {
        r.cycle();
        watch.look();
        if (!r.diverged.empty() && !told) {
            told = true;
            progress.clear();
            if (o.on_nan == OnNan::stop) throw std::runtime_error("stopped: " + r.diverged);
            fmt::print(stderr, "warning: {}\n  hint: --on-nan stop ends the run there\n", r.diverged);
        }
        checkpoints.follow(r);
        if (o.real_time)
            if (const double ahead = r.seconds() - begun - progress.elapsed(); ahead > 0)
                std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
        if (progress.due())
            progress.draw({length.done(simulation.cycle()), simulation.cycle(), r.seconds(), length.text()});
        outcome.stopped = noted_signal() ? stopped_by(noted_signal()) : length.hopeless();
        if (noted_signal()) checkpoints.stop(r);
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

/// Removes what a run that was killed left unfinished in the directory of results, or refuses to: its
/// checkpoint is worth the time that it took.
void clear_directory(const RunOptions& o, Diagnostics& diagnostics) {
    if (has_checkpoint(o.directory) && !o.discard_checkpoint)
        return diagnostics.error(
            {}, fmt::format("'{}' holds the checkpoint of a run that has not finished", o.directory),
            fmt::format("'forage resume {}' continues that run; --discard-checkpoint gives it up, and -o "
                        "names another directory",
                        o.directory));
    remove_checkpoints(o.directory);
    const auto removed = remove_unfinished(o.directory);
    if (!removed.empty())
        diagnostics.warning(
            {}, fmt::format("removed from '{}', as a run was killed before it finished them: {}", o.directory,
                            fmt::join(removed, ", ")));
}

}  // namespace

int run(const RunOptions& options) {
    Diagnostics diagnostics;
    if (!(options.recordings.empty() && options.plots.empty()) && options.directory.empty())
        diagnostics.error({}, "--record and --plot need a directory to write to",
                          "leave out -o '' or name one");
    const Sources sources = read(options.input, diagnostics);
    auto running = prepare(sources, options, diagnostics);
    if (running && !options.directory.empty()) clear_directory(options, diagnostics);
    if (diagnostics.failed() || !options.quiet) fmt::print(stderr, "{}", format(diagnostics));
    if (!running || diagnostics.failed()) return bad_input;
    try {
        check_result_names(options, *running);
        if (running->recordings) running->recordings->begin();
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n  hint: choose another directory for the results with -o\n", e.what());
        return bad_input;
    }
    return carry_on(options, sources, *running);
}

int carry_on(const RunOptions& options, const Sources& sources, Running& running) {
    note_signals();
    const Length length(options, running.loaded.world.get(), running.seconds_per_cycle);
    Progress progress(!options.quiet);
    Outcome outcome;
    outcome.length = length.cycles();
    outcome.first_cycle = running.simulation.cycle();
    std::vector<std::string> problems;
    Watch watch(options.directory);
    try {
        Checkpoints checkpoints(options, sources, running);
        loop(options, running, length, checkpoints, watch, progress, outcome);
    } catch (const std::exception& e) {
        outcome.stopped = e.what();
        problems.emplace_back(e.what());
    }
    if (running.film) try {
            outcome.frames = running.film->finish();
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }
    note(running, outcome);
    outcome.clock = std::max(progress.elapsed(), 1e-9);
    progress.clear();
    if (options.hash) try {
            outcome.state = state_digest(running);
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }

    if (watch.gone())
        problems = {watch.current_exception_message()};
    else if (!options.directory.empty())
        for (auto& problem : write_results(options, running, outcome))
            if (std::find(problems.begin(), problems.end(), problem) == problems.end())
                problems.push_back(std::move(problem));
    const bool finished = problems.empty() && !noted_signal();
    if (options.checkpoint_every && finished) remove_checkpoints(options.directory);
    outcome.resumable = options.checkpoint_every && !finished && has_checkpoint(options.directory);
    if (!options.quiet) fmt::print("{}", summary(options, running.loaded, outcome));
    for (const auto& problem : problems) fmt::print(stderr, "error: {}\n", problem);
    if (!problems.empty()) return run_failed;
    return noted_signal() ? 128 + noted_signal() : fine;
}

}  // namespace forage::tool
