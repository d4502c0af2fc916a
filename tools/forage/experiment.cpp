#include "tools/api/experiment/experiment.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/print.h"
#include "core/run/bundle.h"
#include "core/run/experiment/rounds.h"
#include "core/run/experiment/tables.h"
#include "tools/cluster/slurm.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"
#include "tools/forage/progress.h"
#include "tools/forage/stop.h"

namespace forage::tool {
namespace {

/// "round 2: "; empty for an experiment without rounds.
std::string round_text(std::size_t round) { return round > 0 ? fmt::format("round {}: ", round) : ""; }

/// "12/30 runs, 1 failed, 3 min left".
std::string progress_text(const ExperimentCallbacks::Progress& p) {
    std::string text = round_text(p.round) + fmt::format("{}/{} runs", p.finished, p.all);
    if (p.failed > 0) text += fmt::format(", {} failed", p.failed);
    if (p.seconds_left) text += fmt::format(", {} left", duration_text(*p.seconds_left));
    return text;
}

/// The findings about a system, for printing. Returns the exit status.
int print_findings(const std::string& system, std::span<const Finding> all) {
    const auto met = std::ranges::count_if(all, &Finding::met);
    if (all.empty())
        print("{}: this exercise requires nothing of a system\n", system);
    else
        print("{}: {} of {} requirements are met\n", system, met, all.size());
    for (const auto& f : all) {
        print("  {}  {}\n", f.met ? "yes" : "no ", f.what);
        if (!f.advice.empty()) print("       {}\n", f.advice);
    }
    return met == std::ssize(all) ? fine : run_failed;
}

ExperimentCallbacks callbacks_of(Progress& progress) {
    return {.progress =
                [&](const ExperimentCallbacks::Progress& p) {
                    if (progress.due()) progress.draw(p.done, progress_text(p));
                },
            .interrupted = [] { return noted_signal() != 0; }};
}

/// Prepares for signals and for crashes of plugins.
void begin(const PreparedExperiment& e) {
    note_signals("the current cycle of each run");
    std::vector<std::string> plugins;
    for (const auto& [path, sources] : e.sources)
        for (const auto& p : sources.plugins) plugins.push_back(p.path);
    plugin::tell_crashes(plugins);
}

/// Tells that the runs were interrupted. Returns the exit status.
int print_stopped() {
    print(stderr, "stopped {}; the same command continues with the unfinished runs\n",
          stopped_by(noted_signal()));
    return 128 + noted_signal();
}

/// Prints what became of the runs, and returns the exit status.
int print_results(const ExperimentOptions& o, const PreparedExperiment& e,
                  const std::vector<RunResult>& results) {
    const auto& runs = e.runs;
    if (const auto diverged = divergence_summary(runs, results); !diverged.empty())
        print(stderr, "warning: {}\n", diverged);
    if (!o.quiet) print(stderr, "{}", format(warnings_of(runs, results)));
    if (!o.quiet)
        for (const auto& note : event_notes(results)) print(stderr, "note: {}\n", note);
    if (const auto note = adaptation_note(e.experiment, runs, results); !note.empty() && !o.quiet)
        print(stderr, "note: {}\n", note);
    std::size_t failures = 0;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!results[i].failure.empty()) {
            ++failures;
            print(stderr, "error: run '{}': {}\n", runs.name(i), results[i].failure);
        }
    if (!o.quiet && o.system.empty())
        print("{}: {} runs{}\n{}  written: {}, {}\n", o.file, runs.size(),
              failures ? fmt::format(", {} failed", failures) : "", summary_text(e.experiment, runs, results),
              e.results_file(), e.summary_file());
    return failures ? run_failed : fine;
}

std::vector<observe::TableFormat> formats_of(const ExperimentOptions& o) {
    std::vector<observe::TableFormat> out;
    for (const auto& format : o.formats)
        out.push_back(format == "npy" ? observe::TableFormat::npy : observe::TableFormat::hdf5);
    return out;
}

std::string round_of(const PreparedExperiment& e) {
    return round_text(e.experiment.adaptation ? e.round : 0);
}

/// Executes one part.
int execute_shard(const ExperimentOptions& o, PreparedExperiment& e) {
    begin(e);
    Progress progress(!o.quiet);
    const auto out = run_part(e, *parse_shard(o.shard), o.jobs, o.fresh, callbacks_of(progress));
    progress.clear();
    for (const auto& [run, reason] : out.failures) print(stderr, "error: run '{}': {}\n", run, reason);
    if (!out.finished) return print_stopped();
    if (!o.quiet) print("{}: part {}: {}{} runs executed now\n", o.file, o.shard, round_of(e), out.runs);
    return out.failures.empty() ? fine : run_failed;
}

int print_status(PreparedExperiment& e) {
    const PartResults found = read_results(e);
    const std::size_t done = found.finished(), failed = found.failed(), left = e.runs.size() - done - failed;
    print("{}{}/{} runs", round_of(e), done + failed, e.runs.size());
    if (failed > 0) print(", {} failed", failed);
    if (found.rate > 0) {
        print(", {} runs/s", plain_number(found.rate, 3));
        if (left > 0) print(", {} left", duration_text(static_cast<double>(left) / found.rate));
    }
    print("\n");
    if (found.damaged > 0) print("{} lines of parts cannot be read\n", found.damaged);
    for (const auto& job : cluster::submitted_jobs(e.directory)) print("{}\n", job);
    return fine;
}

int submit(const ExperimentOptions& o, PreparedExperiment& e) {
    cluster::SlurmJob job{o.file, e.directory, o.plugins, o.sbatch, o.tasks};
    if (e.experiment.adaptation) read_results(e), job.round = e.round;
    Diagnostics diagnostics;
    const auto text = cluster::submit(job, e.runs.size(), o.dry_run, diagnostics);
    print(stderr, "{}", format(diagnostics));
    print("{}", text);
    return diagnostics.failed() ? run_failed : fine;
}

/// What parts need: everything but executing all runs here.
int experiment_in_parts(const ExperimentOptions& o) {
    Diagnostics diagnostics;
    auto e = prepare_part(o.file, o.directory, o.plugins, diagnostics);
    if (diagnostics.failed() || !o.quiet) print(stderr, "{}", format(diagnostics));
    if (!e) return bad_input;
    if (!o.shard.empty()) return execute_shard(o, *e);
    if (o.status) return print_status(*e);
    if (o.slurm) return submit(o, *e);
    e->formats = formats_of(o);
    Diagnostics merging;
    const auto results = merge(*e, merging);
    if (!results && o.after_round > 0 && e->round > o.after_round) {
        Diagnostics submitting;
        print("{}", cluster::submit_round(e->directory, e->round, submitting));
        print(stderr, "{}", format(submitting));
        return submitting.failed() ? run_failed : fine;
    }
    print(stderr, "{}", format(merging));
    return results ? print_results(o, *e, *results) : run_failed;
}

}  // namespace

std::vector<std::string> command_of(const ExperimentOptions& o) {
    std::vector<std::string> out = {"experiment", o.file};
    for (const auto& plugin : o.plugins) out.insert(out.end(), {"--plugin", plugin});
    for (const auto& format : o.formats) out.insert(out.end(), {"--table-format", format});
    return out;
}

int experiment(const ExperimentOptions& o) {
    if (!o.shard.empty() || o.merge || o.status || o.slurm) return experiment_in_parts(o);
    Diagnostics diagnostics;
    auto wanted = prepare_experiment(o.file, o.directory, o.plugins, diagnostics, o.system);
    if (diagnostics.failed() || !o.quiet) print(stderr, "{}", format(diagnostics));
    if (!wanted) return bad_input;
    begin(*wanted);
    const InputFiles inputs = o.bundle.empty() ? InputFiles() : input_files(o.file, *wanted);
    wanted->formats = formats_of(o);
    Progress progress(!o.quiet);
    const auto results = run_experiment(*wanted, o.jobs, o.fresh, callbacks_of(progress));
    progress.clear();
    if (!results) return print_stopped();
    const int status = print_results(o, *wanted, *results);
    if (status == fine && !o.bundle.empty())
        write_bundle(o.bundle, command_of(o), inputs, {}, wanted->directory, result_files(*wanted));
    if (status != fine || o.system.empty()) return status;
    const int met = print_findings(o.system, findings(*wanted, *results, diagnostics));
    print("  results in {}\n", std::filesystem::path(wanted->results_file()).parent_path().string());
    return met;
}

void add_experiment(Program& program) {
    const auto added = program.add(
        "experiment", "Run a system many times, with different seeds and parameters, on all cores",
        experiment,
        "Runs that were finished before an interruption are not repeated. docs/reference/experiment.md\n"
        "describes FILE.\n"
        "Example:\n"
        "  forage experiment systems/light_threshold.xml\n"
        "On a cluster (docs/how-to/cluster.md):\n"
        "  forage experiment systems/light_threshold.xml --slurm --partition short --time 1:00:00\n"
        "  forage experiment systems/light_threshold.xml --status");
    CLI::App& command = added.app;
    ExperimentOptions& o = added.options;
    add_value(command, "FILE", o.file, " ", "Experiment file (.xml)")->required();
    add_value(command, "-o,--output", o.directory, "DIR",
              "Directory for results [forage-out/ and FILE's name]")
        ->check(named("directory"));
    add_value(command, "-j,--jobs", o.jobs, "N", "Number of simultaneous runs [one per core]")
        ->transform(threads());
    add_plugins(command, o.plugins);
    command.add_flag("--fresh", o.fresh, "Repeat finished runs");
    repeated(command.add_option(
                 "--table-format", o.formats,
                 "Write the results also as results.npy or results.h5: npy or hdf5; may be repeated"))
        ->check(one_of({"npy", "hdf5"}))
        ->option_text("FORMAT");
    auto* bundle = add_value(command, "--bundle", o.bundle, "FILE",
                             "Write everything that repeats the experiment, and its results, to one "
                             ".zip file for 'forage rerun' and for archives")
                       ->check(named("file"));
    command.add_flag("-q,--quiet", o.quiet, "Print errors only");
    const std::string cluster = "Many machines";
    auto* shard = command.add_option("--shard", o.shard, "Execute part I of N parts only, such as 3/10");
    shard->check(CLI::Validator(
        [](const std::string& text) {
            return parse_shard(text) ? std::string() : fmt::format("'{}' is not a part such as 3/10", text);
        },
        ""));
    shard->option_text("I/N")->group(cluster);
    auto* merge = command.add_flag("--merge", o.merge, "Write the tables of what the parts have left");
    auto* status = command.add_flag("--status", o.status, "Show how many runs are finished, and the rate");
    auto* slurm = command.add_flag("--slurm", o.slurm, "Submit all parts to Slurm, and a merge behind them");
    for (auto* flag : {merge, status, slurm}) flag->group(cluster)->excludes(shard);
    for (auto* flag : {shard, merge, status, slurm}) flag->excludes(bundle);
    merge->excludes(status)->excludes(slurm), status->excludes(slurm);
    add_value(command, "--after-round", o.after_round, "N",
              "With --merge, in the script of --slurm: when round N is complete and another one "
              "follows, submit it")
        ->needs(merge)
        ->group(cluster);
    command.add_flag("--dry-run", o.dry_run, "With --slurm: only write the scripts")
        ->needs(slurm)
        ->group(cluster);
    add_value(command, "--array-size", o.tasks, "N",
              "With --slurm: number of parts [100, or that of the runs]")
        ->needs(slurm)
        ->transform(count())
        ->group(cluster);
    const auto pass_on = [&](const char* name, const char* description, const char* value) {
        command
            .add_option_function<std::string>(
                name,
                [&o, option = std::string(name)](const std::string& v) {
                    o.sbatch.push_back(option + "=" + v);
                },
                description)
            ->needs(slurm)
            ->option_text(value)
            ->group(cluster);
    };
    pass_on("--partition", "With --slurm: the partition", "NAME");
    pass_on("--time", "With --slurm: the time limit of a part", "TIME");
    add_each(
        command, "--sbatch", [&o](const std::string& option) { o.sbatch.push_back(option); }, "OPTION",
        "With --slurm: another option of sbatch, such as --account=ME")
        ->needs(slurm)
        ->group(cluster);
}

}  // namespace forage::tool
