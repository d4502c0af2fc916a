#include "core/run/experiment/runs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "core/model/edit.h"
#include "core/model/validate.h"
#include "core/run/run_json.h"

namespace forage {
namespace {

/// Checks one value of a sweep instead of the first one.
void check_value(const model::Sweep& sweep, const model::Expression& value, const Run& run,
                 Diagnostics& diagnostics) {
    const auto assignment =
        model::parse_assignment(run.system(), run.registry(), sweep.parameter.text + "=" + value.text,
                                "sweep", diagnostics, value.at);
    if (!assignment) return;
    model::System system = run.system();
    model::set(system, *assignment);
    Diagnostics found;
    model::validate(system, run.registry(), found, run.environment());
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

/// The work that all threads share.
class Work {
  public:
    Work(const model::Experiment& experiment, const PrepareRun& prepare, std::span<const PlannedRun> runs,
         bool fresh, const ExperimentCallbacks& callbacks)
        : experiment_(experiment),
          prepare_(prepare),
          runs_(runs),
          results_(runs.size()),
          callbacks_(callbacks) {
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (!fresh) results_[i] = read_result(runs[i], key(i));
            if (!results_[i]) open_.push_back(i);
        }
        earlier_ = runs.size() - open_.size();
    }

    std::size_t open() const { return open_.size(); }

    /// Executes runs until none is left, or the experiment is interrupted. `part` is the completed fraction
    /// of the current run.
    void take_part(std::atomic<double>& part) {
        for (std::size_t i; (i = next_++) < open_.size() && !interrupted();) {
            auto result = make(open_[i], part);
            if (!result) return;
            part = 0;
            const std::lock_guard lock(results_mutex_);
            (result->failure.empty() ? done_ : failed_) += 1;
            results_[open_[i]] = std::move(result);
        }
    }

    /// `parts` is the sum of the completed fractions of the current runs, and `elapsed` is the time since the
    /// start, s.
    ExperimentCallbacks::Progress progress(double parts, double elapsed) const {
        ExperimentCallbacks::Progress out;
        const double made = static_cast<double>(done_ + failed_) + parts;
        out.finished = earlier_ + done_ + failed_, out.failed = failed_, out.all = runs_.size();
        out.done = (static_cast<double>(earlier_) + made) / static_cast<double>(runs_.size());
        if (made > 0.02 && elapsed > 1)
            out.seconds_left = elapsed * (static_cast<double>(open_.size()) - made) / made;
        return out;
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
    std::string key(std::size_t run) const { return key_of(runs_[run], experiment_); }
    bool interrupted() const { return callbacks_.interrupted && callbacks_.interrupted(); }

    /// The results, or nothing when the experiment was interrupted.
    std::optional<RunResult> make(std::size_t index, std::atomic<double>& part) {
        const PlannedRun& run = runs_[index];
        try {
            forget_result(run);
            Diagnostics diagnostics;
            std::optional<PreparedRun> prepared;
            {
                const std::lock_guard lock(libraries_);
                prepared = prepare_(run.spec, diagnostics);
                ResultFiles files(run.spec.directory);
                if (prepared)
                    for (const auto& o : prepared->run.observers()) o->begin_files(files);
            }
            if (!prepared) return failed(first_error(diagnostics));
            return make(index, *prepared, part);
        } catch (const std::exception& e) {
            return failed(e.what());
        }
    }

    std::optional<RunResult> make(std::size_t index, PreparedRun& prepared, std::atomic<double>& part) {
        Run& run = prepared.run;
        RunResult result;
        bool stopped_by_user = false;
        while (!prepared.stop.reached(run) && result.stopped.empty() && !stopped_by_user) {
            run.step();
            part.store(prepared.stop.fraction_done(run), std::memory_order_relaxed);
            stopped_by_user = interrupted();
            result.stopped = prepared.stop.timeout_reason(run);
        }
        result.diverged = run.divergence();
        if (prepared.stop.fraction_done(run) < 1 && prepared.stop.holds(run))
            result.until = prepared.spec.length.until.text;
        for (const auto& change : prepared.schedule->entries())
            if (!change.cycle) result.never.push_back(change.text);
        result.cycles = run.cycle(), result.seconds = run.seconds();
        if (run.has_trials()) {
            const auto& trials = run.environment()->trials(0);
            result.trials = trials.size();
            result.reached = static_cast<std::uint64_t>(
                std::count_if(trials.begin(), trials.end(), [](const Trial& t) { return t.reached_target; }));
        }
        result.measures = run.measure(*prepared.measures);
        ResultFiles files(prepared.spec.directory);
        {
            const std::lock_guard lock(libraries_);
            run.finish(files);
        }
        for (const auto& w : files.warnings().all()) result.warnings.emplace_back(w.message, w.hint);
        RunOutcome outcome;
        outcome.stopped = result.stopped, outcome.files = files;
        files.write("run.json", [&] { return run_json(prepared, outcome); });  // for `forage plot` and `view`
        if (stopped_by_user) return std::nullopt;
        if (!files.problems().empty()) return failed(files.problems().front());
        write_result(runs_[index], key(index), result, files.names());
        return result;
    }

    const model::Experiment& experiment_;
    const PrepareRun& prepare_;
    std::span<const PlannedRun> runs_;
    std::vector<std::optional<RunResult>> results_;
    const ExperimentCallbacks& callbacks_;
    std::vector<std::size_t> open_;  ///< runs that have no result yet
    std::size_t earlier_ = 0;        ///< runs that had one at the start
    std::atomic<std::size_t> next_ = 0, done_ = 0, failed_ = 0;
    /// Libraries that read files or draw must not be used by two threads at the same time.
    std::mutex libraries_;
    std::mutex results_mutex_;
};

/// Checks the first of the runs of one system, and the values of parameters that only the others have.
void check_runs(const model::Experiment& e, const PrepareRun& prepare,
                std::span<const PlannedRun* const> runs, Diagnostics& diagnostics) {
    RunSpec spec = runs.front()->spec;
    spec.directory.clear();  // nothing is written
    auto prepared = prepare(spec, diagnostics);
    if (!prepared) {  // the swept values are checked nevertheless
        RunSpec bare;
        bare.input = spec.input;
        Diagnostics told;
        prepared = prepare(bare, told);
    }
    for (std::size_t i = 0; prepared && i < e.sweeps.size(); ++i) {
        if (!e.sweeps[i].files.empty()) continue;
        std::set<std::string> open;
        for (const auto* run : runs) open.insert(run->values[i]);
        open.erase(runs.front()->values[i]);
        for (const auto& value : e.sweeps[i].values)
            if (open.erase(value.text)) check_value(e.sweeps[i], value, prepared->run, diagnostics);
    }
}

/// Whether `all` has the same message at the same place.
bool contains(const Diagnostics& all, const Diagnostic& d) {
    return std::any_of(all.all().begin(), all.all().end(), [&](const Diagnostic& other) {
        return other.message == d.message && other.where.file == d.where.file &&
               other.where.line == d.where.line && other.where.column == d.where.column;
    });
}

}  // namespace

void check_experiment(const model::Experiment& e, const PrepareRun& prepare, std::span<const PlannedRun> runs,
                      Diagnostics& diagnostics) {
    std::map<std::string, std::vector<const PlannedRun*>> by_system;
    for (const auto& run : runs) by_system[run.spec.input.system].push_back(&run);
    if (by_system.size() == 1) return check_runs(e, prepare, by_system.begin()->second, diagnostics);
    if (diagnostics.failed()) return;  // a system is missing
    std::vector<Diagnostics> found;
    for (const auto& [system, its_runs] : by_system) check_runs(e, prepare, its_runs, found.emplace_back());
    // What is wrong with all systems is reported once; otherwise the message names the system.
    for (auto system = by_system.begin(); const Diagnostics& of_system : found) {
        for (Diagnostic d : of_system.all()) {
            const bool in_all = std::all_of(found.begin(), found.end(),
                                            [&](const Diagnostics& other) { return contains(other, d); });
            if (in_all && &of_system != &found.front()) continue;
            if (!in_all && (!d.where.file || d.where.file->path == e.path))
                d.message = fmt::format("system '{}': {}", system->first, d.message);
            diagnostics.add(std::move(d));
        }
        ++system;
    }
}

std::optional<std::vector<RunResult>> run_experiment(const model::Experiment& experiment,
                                                     const PrepareRun& prepare,
                                                     std::span<const PlannedRun> runs, int jobs, bool fresh,
                                                     const ExperimentCallbacks& callbacks) {
    Work work(experiment, prepare, runs, fresh, callbacks);
    std::vector<std::atomic<double>> parts(std::min(static_cast<std::size_t>(jobs), work.open()));
    std::atomic<std::size_t> busy = parts.size();
    std::vector<std::thread> threads;
    const auto begun = std::chrono::steady_clock::now();
    for (auto& part : parts)
        threads.emplace_back([&work, &part, &busy] {
            work.take_part(part);
            --busy;
        });
    while (busy > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (!callbacks.progress) continue;
        double sum = 0;
        for (const auto& part : parts) sum += part;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun;
        callbacks.progress(work.progress(sum, elapsed.count()));
    }
    for (auto& thread : threads) thread.join();
    return work.results();
}

}  // namespace forage
