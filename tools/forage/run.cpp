#include <cstdio>
#include <thread>

#include "core/base/number.h"
#include "core/base/print.h"
#include "core/run/checkpoint_file.h"
#include "core/run/explain.h"
#include "tools/forage/commands.h"
#include "tools/forage/progress.h"
#include "tools/forage/stop.h"
#include "tools/forage/summary.h"

namespace forage::tool {

int run(const RunOptions& o) {
    Diagnostics diagnostics;
    const RunSpec& spec = o.spec;
    if (!(spec.recordings.empty() && spec.plots.empty()) && spec.directory.empty())
        diagnostics.error({}, "--record and --plot need a directory to write to",
                          "leave out -o '' or name one");
    ask_for_trust(spec.input);
    const Sources sources = read_sources(spec.input, diagnostics);
    auto prepared = prepare(sources, spec, diagnostics);
    if (prepared && !spec.directory.empty()) clear_directory(spec, diagnostics);
    if (diagnostics.failed() || !o.quiet) print(stderr, "{}", format(diagnostics));
    if (!prepared || diagnostics.failed()) return bad_input;
    try {
        begin_files(*prepared);
    } catch (const std::exception& e) {
        print(stderr, "error: {}\n  hint: choose another directory for the results with -o\n", e.what());
        return bad_input;
    }
    return run_to_end(o, *prepared);
}

int run_to_end(const RunOptions& o, PreparedRun& prepared) {
    note_signals("cycle");
    plugin::tell_crashes(prepared.plugins);
    Run& run = prepared.run;
    note_cycle(run.cycle());
    Progress progress(!o.quiet);
    const double begun = run.seconds();
    RunCallbacks callbacks;
    callbacks.takes_long = [&](double seconds) {
        if (o.quiet) return;
        progress.clear();
        print(stderr, "note: this run will take about {}; Ctrl-C stops it and {}\n", duration_text(seconds),
              prepared.checkpoints ? "writes a checkpoint, from which 'forage resume' continues"
                                   : "keeps its results up to there");
    };
    callbacks.diverged = [&](const std::string& what) {
        progress.clear();
        print(stderr, "warning: {}\n  hint: --on-nan stop ends the run there\n", what);
    };
    callbacks.commanded = [&](const std::string& what) {
        if (o.quiet) return;
        progress.clear();
        print(stderr, "remote: {}\n", what);
    };
    if (prepared.remote && !o.quiet) {
        print(stderr, "remote: commands are received at {}\n", prepared.remote->address());
        if (prepared.remote->paused())  // it was when the checkpoint was written
            print(stderr, "remote: the run is stopped; cmd:start continues it\n");
        std::fflush(stderr);
    }
    callbacks.after_cycle = [&] {
        note_cycle(run.cycle());
        if (o.real_time)
            if (const double ahead = run.seconds() - begun - progress.elapsed() +
                                     (prepared.remote ? prepared.remote->waited() : 0);
                ahead > 0)
                std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
        if (progress.due())
            progress.draw(
                {prepared.stop.fraction_done(run), run.cycle(), run.seconds(), prepared.stop.progress(run)});
    };
    callbacks.interrupted = [] { return noted_signal() ? stopped_by(noted_signal()) : std::string(); };

    const RunOutcome outcome = forage::run_to_end(prepared, callbacks);
    progress.clear();
    const std::string& directory = prepared.spec.directory;
    const bool finished = outcome.problems.empty() && !noted_signal();
    if (prepared.checkpoints && finished) remove_checkpoints(directory);
    const bool resumable = prepared.checkpoints && !finished && has_checkpoint(directory);
    if (!o.quiet) print("{}", summary(prepared, outcome, resumable));
    if (!o.quiet) print(stderr, "{}", format(outcome.files.warnings()));
    if (prepared.statistics) {
        print("\n{}", activity_table(run.layout(), *prepared.statistics));
        print("\n");
        for (const auto& note : explanation(prepared)) print("- {}\n", note);
    }
    for (const auto& problem : outcome.problems) print(stderr, "error: {}\n", problem);
    if (!outcome.problems.empty()) return run_failed;
    if (noted_signal()) return 128 + noted_signal();
    if (outcome.stopped.empty()) return fine;
    print(stderr, "error: {}\n", outcome.stopped);
    return run_failed;
}

}  // namespace forage::tool
