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
#include "core/run/result_names.h"
#include "core/run/run_json.h"

namespace forage {
namespace {

/// Whether `all` has the same message at the same place.
bool contains(const Diagnostics& all, const Diagnostic& d) {
    return std::any_of(all.all().begin(), all.all().end(), [&](const Diagnostic& other) {
        return other.message == d.message && other.where.file == d.where.file &&
               other.where.line == d.where.line && other.where.column == d.where.column;
    });
}

/// Checks one value of a sweep instead of the first one, in a system whose own mistakes are known.
void check_value(const model::Sweep& sweep, const model::Expression& value, const model::System& system,
                 const Run& run, const Diagnostics& known, Diagnostics& diagnostics) {
    const auto assignment =
        model::parse_assignment(system, run.registry(), sweep.parameter.text + "=" + value.text, "sweep",
                                diagnostics, sweep.parameter.at, value.at);
    if (!assignment) return;
    Diagnostics found;
    model::validate(model::with(system, *assignment), run.registry(), found, run.environment());
    for (const auto& d : found.all())
        if (d.severity == Severity::error && !contains(known, d))
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
    Work(const RunBlock& block, const KeepResult& keep, const ExperimentCallbacks& callbacks)
        : block_(block), keep_(keep), callbacks_(callbacks) {}

    /// Executes runs until none is left, or the experiment is interrupted. `part` is the completed fraction
    /// of the current run.
    void take_part(std::atomic<double>& part) {
        for (std::size_t i; (i = next_++) < block_.open.size() && !interrupted() && !error_;) {
            std::string trials;
            auto result = make(block_.open[i], part, trials);
            if (!result) return;
            part = 0;
            const std::lock_guard lock(results_mutex_);
            (result->failure.empty() ? done_ : failed_) += 1;
            try {
                keep_(block_.open[i], std::move(*result), trials);
            } catch (...) {
                kept_badly_ = std::current_exception();
                error_ = true;
            }
        }
    }

    /// `parts` is the sum of the completed fractions of the current runs, and `elapsed` is the time since the
    /// start, s.
    ExperimentCallbacks::Progress progress(double parts, double elapsed) const {
        ExperimentCallbacks::Progress out;
        const double made = static_cast<double>(done_ + failed_) + parts;
        out.finished = block_.earlier + done_ + failed_, out.failed = failed_;
        out.all = block_.earlier + block_.open.size(), out.round = block_.round;
        out.done = (static_cast<double>(block_.earlier) + made) / static_cast<double>(out.all);
        if (made > 0.02 && elapsed > 1)
            out.seconds_left = elapsed * (static_cast<double>(block_.open.size()) - made) / made;
        return out;
    }

    /// Whether all runs were executed. Throws what keeping a result threw.
    bool finished() const {
        if (kept_badly_) std::rethrow_exception(kept_badly_);
        return done_ + failed_ == block_.open.size();
    }

  private:
    bool interrupted() const { return callbacks_.interrupted && callbacks_.interrupted(); }

    /// The results, or nothing when the experiment was interrupted.
    std::optional<RunResult> make(std::size_t index, std::atomic<double>& part, std::string& table) {
        PlannedRun run = block_.plan[index];
        if (!block_.files) run.spec.directory.clear();
        try {
            if (block_.files) forget_result(run);
            Diagnostics diagnostics;
            std::optional<PreparedRun> prepared;
            {
                const std::lock_guard lock(libraries_);
                prepared = block_.prepare(run.spec, diagnostics);
                if (prepared) begin_files(*prepared);
            }
            if (!prepared) return failed(first_error(diagnostics));
            return make(run, *prepared, part, table);
        } catch (const std::exception& e) {
            return failed(e.what());
        }
    }

    std::optional<RunResult> make(const PlannedRun& planned, PreparedRun& prepared, std::atomic<double>& part,
                                  std::string& table) {
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
            result.reached =
                static_cast<std::uint64_t>(std::ranges::count_if(trials, &Trial::reached_target));
        }
        result.measures = run.measure(*prepared.measures);
        ResultFiles files(prepared.spec.directory, trials_file());
        {
            const std::lock_guard lock(libraries_);
            run.finish(files);
        }
        for (const auto& w : files.warnings().all()) result.warnings.emplace_back(w.message, w.hint);
        RunOutcome outcome;
        outcome.stopped = result.stopped, outcome.files = files;
        if (block_.files)  // for `forage plot` and `view`
            files.write("run.json", [&] { return run_json(prepared, outcome); });
        if (stopped_by_user) return std::nullopt;
        if (!files.problems().empty()) return failed(files.problems().front());
        table = files.kept();
        if (block_.files) write_result(planned, key_of(planned, block_.experiment), result, files.names());
        return result;
    }

    const RunBlock& block_;
    const KeepResult& keep_;
    const ExperimentCallbacks& callbacks_;
    std::atomic<std::size_t> next_ = 0, done_ = 0, failed_ = 0;
    /// Libraries that read files or draw must not be used by two threads at the same time.
    std::mutex libraries_;
    std::mutex results_mutex_;
    std::atomic<bool> error_ = false;
    std::exception_ptr kept_badly_;  ///< of the first result that could not be kept
};

/// Checks the first combination of one system, and the values of parameters that only other combinations
/// have.
void check_runs(const model::Experiment& e, const PrepareRun& prepare, const RunPlan& plan, std::size_t first,
                Diagnostics& diagnostics) {
    RunSpec spec = plan[plan.first(first)].spec;
    spec.directory.clear();  // nothing is written
    auto prepared = prepare(spec, diagnostics);
    const bool sound = prepared.has_value();
    if (!sound) {  // the swept values are checked nevertheless
        RunSpec bare;
        bare.input = spec.input, bare.input.settings.clear();
        Diagnostics reported;
        prepared = prepare(bare, reported);
    }
    if (!prepared) return;
    const Run& run = prepared->run;
    model::System system = run.system();
    Diagnostics ignored, known;
    if (!sound) {
        for (const auto& setting : spec.input.settings)
            model::set(system, run.registry(), setting.text, ignored, setting.at, setting.value_at);
        model::validate(system, run.registry(), known, run.environment());
    }
    for (std::size_t i = 0; i < e.sweeps.size(); ++i) {
        const auto& sweep = e.sweeps[i];
        if (!sweep.files.empty() ||
            !model::find_parameter(system, run.registry(), sweep.parameter.text, "sweep", ignored))
            continue;
        std::set<std::string> open;
        for (const auto& value : sweep.values) open.insert(value.text);
        open.erase(plan.values(first)[i]);
        for (const auto& value : sweep.values)
            if (open.erase(value.text)) check_value(sweep, value, system, run, known, diagnostics);
    }
}

}  // namespace

void check_experiment(const model::Experiment& e, const PrepareRun& prepare, const RunPlan& plan,
                      Diagnostics& diagnostics) {
    std::map<std::string, std::size_t> by_system;  // the first combination of each
    for (std::size_t c = 0; c < plan.combinations(); ++c) by_system.try_emplace(plan.system(c), c);
    if (by_system.size() == 1) return check_runs(e, prepare, plan, 0, diagnostics);
    if (diagnostics.failed()) return;  // a system is missing
    std::vector<Diagnostics> found;
    for (const auto& [system, first] : by_system) check_runs(e, prepare, plan, first, found.emplace_back());
    // What is wrong with all systems is reported once; otherwise the message names the system.
    for (auto system = by_system.begin(); const Diagnostics& of_system : found) {
        for (Diagnostic d : of_system.all()) {
            const bool in_all =
                std::ranges::all_of(found, [&](const Diagnostics& other) { return contains(other, d); });
            if (in_all && &of_system != &found.front()) continue;
            if (!in_all && (!d.where.file || d.where.file->path == e.path))
                d.message = fmt::format("system '{}': {}", system->first, d.message);
            diagnostics.add(std::move(d));
        }
        ++system;
    }
}

bool execute_runs(const RunBlock& block, int jobs, const KeepResult& keep,
                  const ExperimentCallbacks& callbacks) {
    Work work(block, keep, callbacks);
    std::vector<std::atomic<double>> parts(std::min(static_cast<std::size_t>(jobs), block.open.size()));
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
    return work.finished();
}

}  // namespace forage
