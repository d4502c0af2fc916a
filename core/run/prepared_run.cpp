#include "core/run/prepared_run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "core/run/checkpoint_file.h"
#include "core/run/run_json.h"

namespace forage {
namespace {

using Clock = std::chrono::steady_clock;

/// Checks, once a second, that the directory for results still exists: otherwise everything written into open
/// files would be lost.
class DirectoryWatch {
  public:
    explicit DirectoryWatch(std::string directory) : directory_(std::move(directory)) {}
    bool gone() const { return !directory_.empty() && access(directory_.c_str(), F_OK) != 0; }
    std::string message() const {
        return fmt::format("the directory '{}' is not there any more", directory_);
    }
    void look() {
        const auto now = Clock::now();
        if (now < next_) return;
        next_ = now + std::chrono::seconds(1);
        if (gone()) throw std::runtime_error(message());
    }

  private:
    std::string directory_;
    Clock::time_point next_;
};

/// Runs until the end, or until something stops it. Returns why it ended early. Throws what a cycle or an
/// observer throws.
std::string loop(PreparedRun& p, const RunCallbacks& callbacks, DirectoryWatch& watch) {
    Run& run = p.run;
    bool told = !run.divergence().empty();  // reported before the stop
    while (!p.stop.reached(run)) {
        run.step();
        watch.look();
        if (!run.divergence().empty() && !told) {
            told = true;
            if (p.spec.on_nan == OnNan::stop) throw std::runtime_error(run.divergence());
            if (callbacks.diverged) callbacks.diverged(run.divergence());
        }
        if (callbacks.after_cycle) callbacks.after_cycle();
        if (auto why = callbacks.interrupted ? callbacks.interrupted() : std::string(); !why.empty()) {
            if (p.checkpoints) p.checkpoints->write(run);
            return why;
        }
        if (auto why = p.stop.timeout_reason(run); !why.empty()) return why;
    }
    return {};
}

void write_results(PreparedRun& p, RunOutcome& outcome) {
    auto& files = outcome.files;
    if (p.spec.directory.empty()) return p.run.finish(files);  // a film has its own path
    const auto earlier = read_run_json(p.spec.directory);
    p.run.finish(files);
    files.write("run.json", [&] { return run_json(p, outcome); });
    const auto written = files.names();
    for (const auto& name : earlier ? earlier->files : std::vector<std::string>())
        if (std::find(written.begin(), written.end(), name) == written.end())
            std::remove(files.path(name).c_str());
}

}  // namespace

RunOutcome run_to_end(PreparedRun& p, const RunCallbacks& callbacks) {
    RunOutcome out;
    out.files = ResultFiles(p.spec.directory);
    out.first_cycle = p.run.cycle();
    DirectoryWatch watch(p.spec.directory);
    const auto begun = Clock::now();
    const auto problem = [&](const std::string& text) {
        if (std::find(out.problems.begin(), out.problems.end(), text) == out.problems.end())
            out.problems.push_back(text);
    };
    try {
        out.stopped = loop(p, callbacks, watch);
    } catch (const std::exception& e) {
        out.stopped = e.what();
        problem(e.what());
    }
    out.clock_seconds = std::max(std::chrono::duration<double>(Clock::now() - begun).count(), 1e-9);
    if (p.spec.digest) try {
            out.state = p.run.digest();
        } catch (const std::exception& e) {
            problem(e.what());
        }
    if (watch.gone()) {
        out.problems = {watch.message()};
    } else {
        write_results(p, out);
        for (const auto& text : out.files.problems()) problem(text);
    }
    return out;
}

}  // namespace forage
