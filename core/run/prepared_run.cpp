#include "core/run/prepared_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "core/run/bundle.h"
#include "core/run/run_json.h"

namespace forage {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether the directory for results was removed: everything written into open files would be lost.
bool is_gone(const std::string& directory) {
    return !directory.empty() && access(directory.c_str(), F_OK) != 0;
}

std::string gone_message(const std::string& directory) {
    return fmt::format("the directory '{}' is not there any more", directory);
}

/// Runs until the end, or until something stops it. Returns why it ended early. Throws what a cycle or an
/// observer throws.
std::string loop(PreparedRun& p, const RunCallbacks& callbacks) {
    constexpr double hour = 3600;
    Run& run = p.run;
    const auto begun = Clock::now();
    const double done_before = p.stop.fraction_done(run);
    auto next_look = begun;
    int looks = 0;                              // one per second
    bool reported = !run.divergence().empty();  // reported before the stop
    const auto interruption = [&] {
        auto why = callbacks.interrupted ? callbacks.interrupted() : std::string();
        if (!why.empty() && p.checkpoints) p.checkpoints->write(run);
        return why;
    };
    if (p.remote) p.remote->log = callbacks.commanded;
    while (!p.stop.reached(run)) {
        if (p.remote) {
            p.remote->execute_pending(run);
            for (; p.remote->paused() && !p.remote->quit(); p.remote->execute_pending(run)) {
                if (auto why = interruption(); !why.empty()) return why;
                p.remote->wait();
            }
            if (p.remote->quit()) return {};
        }
        run.step();
        if (const auto now = Clock::now(); now >= next_look) {
            next_look = now + std::chrono::seconds(1);
            if (is_gone(p.spec.directory)) throw std::runtime_error(gone_message(p.spec.directory));
            if (++looks == 5 && callbacks.takes_long) {
                const double done = p.stop.fraction_done(run),
                             elapsed = std::chrono::duration<double>(now - begun).count();
                const double left = elapsed * (1 - done) / (done - done_before);
                if (left > hour && std::isfinite(left)) callbacks.takes_long(left);
            }
        }
        if (!run.divergence().empty() && !reported) {
            reported = true;
            if (p.spec.on_nan == OnNan::stop) throw std::runtime_error(run.divergence());
            if (callbacks.diverged) callbacks.diverged(run.divergence());
        }
        if (callbacks.after_cycle) callbacks.after_cycle();
        if (auto why = interruption(); !why.empty()) return why;
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
        if (std::ranges::find(written, name) == written.end()) std::remove(files.path(name).c_str());
}

}  // namespace

void begin_files(PreparedRun& p) {
    if (p.spec.directory.empty()) return;
    ResultFiles files(p.spec.directory);
    check_regular_file(files.path("run.json"));
    for (const auto& o : p.run.observers())
        for (const auto& name : o->file_names()) check_regular_file(files.path(name));
    for (const auto& o : p.run.observers()) o->begin_files(files);
}

RunOutcome run_to_end(PreparedRun& p, const RunCallbacks& callbacks) {
    RunOutcome out;
    out.files = ResultFiles(p.spec.directory);
    out.first_cycle = p.run.cycle();
    const auto begun = Clock::now();
    const auto problem = [&](const std::string& text) {
        if (std::ranges::find(out.problems, text) == out.problems.end()) out.problems.push_back(text);
    };
    try {
        out.stopped = loop(p, callbacks);
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
    if (is_gone(p.spec.directory)) {
        out.problems = {gone_message(p.spec.directory)};
    } else {
        write_results(p, out);
        for (const auto& text : out.files.problems()) problem(text);
        if (!p.spec.bundle.empty() && out.stopped.empty() && out.problems.empty()) try {
                write_bundle(p.spec.bundle, p.spec.command, p.inputs, p.module_texts, p.spec.directory,
                             out.files.names());
            } catch (const std::exception& e) {
                problem(e.what());
            }
    }
    return out;
}

}  // namespace forage
