#include "tools/api/experiment.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/run/experiment/tables.h"
#include "tools/forage/commands.h"
#include "tools/forage/progress.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

/// "12/30 runs, 1 failed, 3 min left".
std::string progress_text(const ExperimentCallbacks::Progress& p) {
    std::string text = fmt::format("{}/{} runs", p.finished, p.all);
    if (p.failed > 0) text += fmt::format(", {} failed", p.failed);
    if (p.seconds_left) text += fmt::format(", {} left", duration_text(*p.seconds_left));
    return text;
}

/// The findings about a system, for printing. Returns the exit status.
int print_findings(const std::string& system, std::span<const Finding> all) {
    const auto met = std::count_if(all.begin(), all.end(), [](const auto& f) { return f.met; });
    if (all.empty())
        fmt::print("{}: this exercise requires nothing of a system\n", system);
    else
        fmt::print("{}: {} of {} requirements are met\n", system, met, all.size());
    for (const auto& f : all) {
        fmt::print("  {}  {}\n", f.met ? "yes" : "no ", f.what);
        if (!f.advice.empty()) fmt::print("       {}\n", f.advice);
    }
    return met == std::ssize(all) ? fine : run_failed;
}

}  // namespace

int experiment(const ExperimentOptions& o) {
    Diagnostics diagnostics;
    const auto wanted = prepare_experiment(o.file, o.directory, o.plugins, diagnostics, o.system);
    if (diagnostics.failed() || !o.quiet) fmt::print(stderr, "{}", format(diagnostics));
    if (!wanted) return bad_input;
    note_signals("the current cycle of each run");
    std::vector<std::string> plugins;
    for (const auto& [path, sources] : wanted->sources)
        for (const auto& p : sources.plugins) plugins.push_back(p.path);
    plugin::tell_crashes(plugins);
    Progress progress(!o.quiet);
    ExperimentCallbacks callbacks;
    callbacks.interrupted = [] { return noted_signal() != 0; };
    callbacks.progress = [&](const ExperimentCallbacks::Progress& p) {
        if (progress.due()) progress.draw(p.done, progress_text(p));
    };
    const auto results = run_experiment(*wanted, o.jobs, o.fresh, callbacks);
    progress.clear();
    if (!results) {
        fmt::print(stderr, "stopped {}; the same command continues with the unfinished runs\n",
                   stopped_by(noted_signal()));
        return 128 + noted_signal();
    }
    const auto& runs = wanted->runs;
    if (const auto diverged = divergence_summary(runs, *results); !diverged.empty())
        fmt::print(stderr, "warning: {}\n", diverged);
    if (!o.quiet) fmt::print(stderr, "{}", format(warnings_of(runs, *results)));
    if (!o.quiet)
        for (const auto& note : event_notes(*results)) fmt::print(stderr, "note: {}\n", note);
    std::size_t failures = 0;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!(*results)[i].failure.empty()) {
            ++failures;
            fmt::print(stderr, "error: run '{}': {}\n", runs[i].name, (*results)[i].failure);
        }
    if (!o.quiet && o.system.empty())
        fmt::print("{}: {} runs{}\n{}  written: {}, {}\n", o.file, runs.size(),
                   failures ? fmt::format(", {} failed", failures) : "",
                   summary_text(wanted->experiment, runs, *results), wanted->results_file(),
                   wanted->summary_file());
    if (failures || o.system.empty()) return failures ? run_failed : fine;
    const int status = print_findings(o.system, findings(*wanted, *results, diagnostics));
    fmt::print("  results in {}\n", std::filesystem::path(wanted->results_file()).parent_path().string());
    return status;
}

}  // namespace forage::tool
