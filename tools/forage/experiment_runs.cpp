#include "tools/forage/experiment_runs.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "core/model/edit.h"
#include "core/model/validate.h"
#include "tools/forage/length.h"
#include "tools/forage/pictures.h"
#include "tools/forage/running.h"
#include "tools/forage/schedule.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

/// One value of a sweep in place of the first one.
void check_value(const model::Sweep& sweep, const model::Expression& value, const Loaded& loaded,
                 Diagnostics& diagnostics) {
    const auto assignment =
        model::parse_assignment(loaded.system, loaded.registry, sweep.parameter.text + "=" + value.text,
                                "sweep", diagnostics, value.at);
    if (!assignment) return;
    model::System system = loaded.system;
    model::set(system, *assignment);
    Diagnostics found;
    model::validate(system, loaded.registry, found, loaded.world.get());
    for (const auto& d : found.all())
        if (d.severity == Severity::error)
            diagnostics.error(
                value.at, fmt::format("{} = {}: {}", sweep.parameter.text, value.text, d.message), d.hint);
}

std::string first_error(const Diagnostics& diagnostics) {
    for (const auto& d : diagnostics.all())
        if (d.severity == Severity::error) return d.message;
    return "unknown";
}

RunResult failed(std::string why) {
    RunResult out;
    out.failure = std::move(why);
    return out;
}

/// What all threads work on.
class Work {
  public:
    Work(const model::Experiment& experiment, const Sources& sources, std::span<const PlannedRun> runs,
         bool fresh)
        : experiment_(experiment),
          sources_(sources),
          runs_(runs),
          results_(runs.size()),
          digests_(digests_of(experiment, sources)) {
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (!fresh) results_[i] = read_result(runs[i], key(i));
            if (!results_[i]) open_.push_back(i);
        }
        earlier_ = runs.size() - open_.size();
    }

    std::size_t open() const { return open_.size(); }

    /// Takes runs until there are none, or a signal comes. `part` is how far the running one is.
    void take_part(std::atomic<double>& part) {
        for (std::size_t i; (i = next_++) < open_.size() && !noted_signal();) {
            auto result = make(open_[i], part);
            if (!result) return;
            part = 0;
            const std::lock_guard lock(results_mutex_);
            (result->failure.empty() ? done_ : failed_) += 1;
            results_[open_[i]] = std::move(result);
        }
    }

    /// "12/30 runs, 1 failed, 3 min left"; `parts`: of the runs under way, `elapsed` s since the start.
    std::pair<double, std::string> progress(double parts, double elapsed) const {
        const std::size_t done = done_, failed = failed_;
        const double made = static_cast<double>(done + failed) + parts;
        std::string text = fmt::format("{}/{} runs", earlier_ + done + failed, runs_.size());
        if (failed > 0) text += fmt::format(", {} failed", failed);
        if (made > 0.02 && elapsed > 1) {
            const double left = elapsed * (static_cast<double>(open_.size()) - made) / made;
            text += left < 100 ? fmt::format(", {:.0f} s left", left)
                               : fmt::format(", {:.0f} min left", left / 60);
        }
        return {(static_cast<double>(earlier_) + made) / static_cast<double>(runs_.size()), text};
    }

    std::optional<std::vector<RunResult>> results() {
        std::vector<RunResult> out;
        for (auto& r : results_) {
            if (!r) return std::nullopt;
            out.push_back(std::move(*r));
        }
        return out;
    }

  private:
    std::string key(std::size_t run) const { return key_of(runs_[run], experiment_, digests_); }

    /// Empty when a signal ended it.
    std::optional<RunResult> make(std::size_t index, std::atomic<double>& part) {
        const PlannedRun& run = runs_[index];
        try {
            forget_result(run);
            Diagnostics diagnostics;
            std::optional<Running> running;
            {
                const std::lock_guard lock(libraries_);
                running = prepare(sources_, run.options, diagnostics);
                if (running && running->recordings) running->recordings->begin();
            }
            if (!running) return failed(first_error(diagnostics));
            return make(index, *running, part);
        } catch (const std::exception& e) {
            return failed(e.what());
        }
    }

    std::optional<RunResult> make(std::size_t index, Running& running, std::atomic<double>& part) {
        const PlannedRun& run = runs_[index];
        const auto* world = running.loaded.world.get();
        const Length length(run.options, world, running.seconds_per_cycle);
        RunResult result;
        while (!length.over(running.simulation.cycle()) && !running.done() && result.stopped.empty()) {
            running.cycle();
            part.store(length.done(running.simulation.cycle()), std::memory_order_relaxed);
            if (noted_signal()) {
                if (running.recordings) running.recordings->finish();
                return std::nullopt;
            }
            result.stopped = length.hopeless();
        }
        result.diverged = running.diverged;
        Outcome outcome;
        note(running, outcome);
        result.cycles = outcome.cycles, result.seconds = outcome.seconds;
        if (has_trials(running.loaded)) {
            result.trials = outcome.trials[0].finished.size();
            result.reached = outcome.trials[0].reached();
        }
        running.run_measures.see(running.simulation, running.now());
        result.measures = running.run_measures.values(running.loaded, running.simulation, running.now());
        auto problems = write_tables(run.options, running, outcome);
        if (problems.empty()) {
            const std::lock_guard lock(libraries_);
            problems = write_pictures(run.options, running, outcome);
        }
        if (!problems.empty()) return failed(problems.front());
        write_result(run, key(index), result, outcome.files);
        return result;
    }

    const model::Experiment& experiment_;
    const Sources& sources_;
    std::span<const PlannedRun> runs_;
    std::vector<std::optional<RunResult>> results_;
    std::string digests_;
    std::vector<std::size_t> open_;  ///< runs that have no result yet
    std::size_t earlier_ = 0;        ///< runs that had one
    std::atomic<std::size_t> next_ = 0, done_ = 0, failed_ = 0;
    std::mutex libraries_;  ///< those that read files and draw may not like company
    std::mutex results_mutex_;
};

}  // namespace

void check_experiment(const model::Experiment& e, const Sources& sources, std::span<const PlannedRun> runs,
                      Diagnostics& diagnostics) {
    RunOptions options = runs.front().options;
    options.directory.clear();  // nothing is written
    prepare(sources, options, diagnostics);
    Diagnostics told;  // by prepare()
    if (const auto loaded = assemble(sources, options.input, told))
        for (const auto& sweep : e.sweeps)
            for (const auto& value : sweep.values)
                if (&value != &sweep.values.front()) check_value(sweep, value, *loaded, diagnostics);
}

std::optional<std::vector<RunResult>> make_runs(const model::Experiment& experiment, const Sources& sources,
                                                std::span<const PlannedRun> runs, int jobs, bool fresh,
                                                Progress& progress) {
    Work work(experiment, sources, runs, fresh);
    std::vector<std::atomic<double>> parts(std::min(static_cast<std::size_t>(jobs), work.open()));
    std::atomic<std::size_t> busy = parts.size();
    std::vector<std::thread> threads;
    for (auto& part : parts)
        threads.emplace_back([&work, &part, &busy] {
            work.take_part(part);
            --busy;
        });
    while (busy > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (!progress.due()) continue;
        double sum = 0;
        for (const auto& part : parts) sum += part;
        const auto [done, text] = work.progress(sum, progress.elapsed());
        progress.draw(done, text);
    }
    for (auto& thread : threads) thread.join();
    progress.clear();
    return work.results();
}

}  // namespace forage::tool
