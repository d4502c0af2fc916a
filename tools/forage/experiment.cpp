
#include "core/xml/experiment.h"

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/cores.h"
#include "core/base/named_file.h"
#include "core/base/output_files.h"
#include "core/run/experiment/runs.h"
#include "core/run/experiment/tables.h"
#include "tools/forage/commands.h"
#include "tools/forage/progress.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

std::string default_directory(const std::string& file) {
    return "forage-out/" + std::filesystem::path(file).stem().string();
}

/// Whether the files of an experiment can be read. Reports those that cannot, with the place where they are
/// named.
bool files_are_there(const model::Experiment& e, Diagnostics& diagnostics) {
    bool all = find_file(e.system, e.system_at, diagnostics);
    if (e.world_at.file) all &= find_file(e.world, e.world_at, diagnostics);
    for (const auto& m : e.manipulations)
        if (!m.patterns.empty()) all &= find_file(m.patterns.text, m.patterns.at, diagnostics);
    return all;
}

/// "12/30 runs, 1 failed, 3 min left".
std::string progress_text(const ExperimentCallbacks::Progress& p) {
    std::string text = fmt::format("{}/{} runs", p.finished, p.all);
    if (p.failed > 0) text += fmt::format(", {} failed", p.failed);
    if (p.seconds_left)
        text += *p.seconds_left < 100 ? fmt::format(", {:.0f} s left", *p.seconds_left)
                                      : fmt::format(", {:.0f} min left", *p.seconds_left / 60);
    return text;
}

}  // namespace

int experiment(const ExperimentOptions& o) {
    Diagnostics diagnostics;
    const auto wanted = xml::read_experiment(o.file, diagnostics);
    const std::string directory = o.directory.empty() ? default_directory(o.file) : o.directory;
    std::vector<PlannedRun> runs;
    Sources sources;
    const PrepareRun prepare_run = [&](const RunSpec& spec, Diagnostics& d) {
        return prepare(sources, spec, d);
    };
    if (wanted && files_are_there(*wanted, diagnostics)) {
        runs = planned_runs(*wanted, directory, o.plugins);
        sources = read_sources(runs.front().spec.input, diagnostics);
        check_experiment(*wanted, prepare_run, runs, diagnostics);
    }
    if (diagnostics.failed() || !o.quiet) fmt::print(stderr, "{}", format(diagnostics));
    if (diagnostics.failed()) return bad_input;

    const std::string results_file = directory + "/results.csv", summary_file = directory + "/summary.csv";
    DirectoryHold hold;
    try {
        make_directory(directory + "/runs");
        for (const auto& table : {results_file, summary_file}) refuse_no_file(table);
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n  hint: choose another directory for the results with -o\n", e.what());
        return bad_input;
    }
    try {
        hold = DirectoryHold(directory);
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n  hint: {}\n", e.what(), held_hint);
        return bad_input;
    }
    note_signals();
    Progress progress(!o.quiet);
    for (const auto& table : {results_file, summary_file})  // an existing table is complete
        std::remove(table.c_str());
    ExperimentCallbacks callbacks;
    callbacks.interrupted = [] { return noted_signal() != 0; };
    callbacks.progress = [&](const ExperimentCallbacks::Progress& p) {
        if (progress.due()) progress.draw(p.done, progress_text(p));
    };
    const auto results =
        run_experiment(*wanted, prepare_run, runs, source_digests(runs.front().spec.input, sources),
                       o.jobs > 0 ? o.jobs : cores(), o.fresh, callbacks);
    progress.clear();
    if (!results) {
        fmt::print(stderr, "stopped {}; the same command continues with the unfinished runs\n",
                   stopped_by(noted_signal()));
        return 128 + noted_signal();
    }
    write_durably(results_file, results_csv(*wanted, runs, *results));
    write_durably(summary_file, summary_csv(*wanted, runs, *results));
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!(*results)[i].diverged.empty())
            fmt::print(stderr, "warning: run '{}': {}\n", runs[i].name, (*results)[i].diverged);
    std::size_t failures = 0;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!(*results)[i].failure.empty()) {
            ++failures;
            fmt::print(stderr, "error: run '{}': {}\n", runs[i].name, (*results)[i].failure);
        }
    if (!o.quiet)
        fmt::print("{}: {} runs{}\n{}  written: {}, {}\n", o.file, runs.size(),
                   failures ? fmt::format(", {} failed", failures) : "",
                   summary_text(*wanted, runs, *results), results_file, summary_file);
    return failures ? run_failed : fine;
}

}  // namespace forage::tool
