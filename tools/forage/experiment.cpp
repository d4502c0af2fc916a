
#include "core/xml/experiment.h"

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "tools/forage/commands.h"
#include "tools/forage/cores.h"
#include "tools/forage/experiment_runs.h"
#include "tools/forage/experiment_tables.h"
#include "tools/forage/files.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

std::string default_directory(const std::string& file) {
    return "forage-out/" + std::filesystem::path(file).stem().string();
}

/// Whether the files that an experiment names can be read; reports where it names those that cannot.
bool files_are_there(const model::Experiment& e, Diagnostics& diagnostics) {
    bool all = find_file(e.system, e.system_at, diagnostics);
    if (e.world_at.file) all &= find_file(e.world, e.world_at, diagnostics);
    for (const auto& m : e.manipulations)
        if (!m.patterns.empty()) all &= find_file(m.patterns.text, m.patterns.at, diagnostics);
    return all;
}

}  // namespace

int experiment(const ExperimentOptions& o) {
    Diagnostics diagnostics;
    const auto wanted = xml::read_experiment(o.file, diagnostics);
    const std::string directory = o.directory.empty() ? default_directory(o.file) : o.directory;
    std::vector<PlannedRun> runs;
    Sources sources;
    if (wanted && files_are_there(*wanted, diagnostics)) {
        runs = planned_runs(*wanted, directory);
        for (auto& run : runs) run.options.input.plugins = o.plugins;
        sources = read(runs.front().options.input, diagnostics);
        check_experiment(*wanted, sources, runs, diagnostics);
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
    for (const auto& table : {results_file, summary_file})  // one that is there is whole
        std::remove(table.c_str());
    const auto results = make_runs(*wanted, sources, runs, o.jobs > 0 ? o.jobs : cores(), o.fresh, progress);
    if (!results) {
        fmt::print(stderr, "stopped {}; the same command goes on with the runs that are not finished\n",
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
