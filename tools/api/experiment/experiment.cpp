#include "tools/api/experiment/experiment.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/base/cores.h"
#include "core/base/named_file.h"
#include "core/run/experiment/rounds.h"
#include "core/run/experiment/tables.h"
#include "core/run/experiment/trials_table.h"
#include "core/xml/experiment.h"
#include "tools/api/experiment/run_table.h"
#include "tools/api/open/prepare.h"

namespace forage {
namespace {

/// Whether the files of an experiment can be read. Reports those that cannot, with the place where they are
/// named.
bool files_are_there(const model::Experiment& e, Diagnostics& diagnostics) {
    bool all = true;
    for (const auto& system : e.systems) all &= find_file(system.text, system.at, diagnostics);
    for (const auto& sweep : e.sweeps)
        for (std::size_t i = 0; i < sweep.files.size(); ++i)
            all &= find_file(sweep.files[i], sweep.values[i].at, diagnostics);
    if (e.world_at.file) all &= find_file(e.world, e.world_at, diagnostics);
    for (const auto& m : e.manipulations)
        if (!m.patterns.empty()) all &= find_file(m.patterns.text, m.patterns.at, diagnostics);
    return all;
}

/// Reads the files of all runs, each file once.
std::map<std::string, Sources> read_all(RunPlan& plan, Diagnostics& diagnostics) {
    std::map<std::string, Sources> out;
    std::map<std::string, std::string> digests;
    for (std::size_t c = 0; c < plan.combinations(); ++c) {
        if (out.contains(plan.system(c))) continue;
        const RunInput input = plan[plan.first(c)].spec.input;
        Sources sources = out.empty() ? read_sources(input, diagnostics)
                                      : with_first_system(out.begin()->second, input, diagnostics);
        if (sources.system) digests[input.system] = source_digests(input, sources);
        out.emplace(input.system, std::move(sources));
    }
    plan.set_files(std::move(digests));
    return out;
}

/// Warns about folders of runs that are not part of the experiment any more. They are kept, as they may hold
/// the only copy of a result.
void report_leftovers(const PreparedExperiment& e, Diagnostics& diagnostics) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(e.directory + "/runs"))
        if (entry.is_directory()) names.insert(entry.path().filename().string());
    for (std::size_t i = 0; i < e.runs.size() && !names.empty(); ++i) names.erase(e.runs.name(i));
    if (names.empty()) return;
    diagnostics.warning(
        {},
        fmt::format("'{}/runs' holds {} folder{} of runs that are not part of this experiment, such as '{}'",
                    e.directory, names.size(), names.size() == 1 ? "" : "s", *names.begin()),
        "tables and pictures leave them out; remove them if you do not need them");
}

/// The directory of results, unless another one is given.
std::string directory_of(const std::string& file, const std::string& directory) {
    return directory.empty() ? "forage-out/" + std::filesystem::path(file).stem().string() : directory;
}

void write_tables(const PreparedExperiment& e, std::span<const RunResult> results, const PartResults& found) {
    write_trials(e.trials_file(), e.runs, results, found);
    write_durably(e.results_file(), results_csv(e.experiment, e.runs, results));
    write_durably(e.summary_file(), summary_csv(e.experiment, e.runs, results));
    for (const auto format : e.formats)
        observe::write_table(
            format, e.directory + (format == observe::TableFormat::npy ? "/results.npy" : "/results.h5"),
            results_columns(e.experiment, e.runs, results), results.size());
}

/// All results, or nothing when a run has none.
std::optional<std::vector<RunResult>> all_of(std::vector<std::optional<RunResult>>& results) {
    std::vector<RunResult> out;
    out.reserve(results.size());
    for (auto& r : results) {
        if (!r) return std::nullopt;
        out.push_back(std::move(*r));
        r.reset();
    }
    return out;
}

}  // namespace

std::optional<PreparedRun> PreparedExperiment::prepare(const RunSpec& spec, Diagnostics& diagnostics) const {
    return forage::prepare(sources.at(spec.input.system), spec, diagnostics);
}

std::optional<PreparedExperiment> plan_experiment(model::Experiment wanted, std::string directory,
                                                  const std::vector<std::string>& plugins,
                                                  Diagnostics& diagnostics, bool exercise) {
    if (!files_are_there(wanted, diagnostics)) return std::nullopt;
    PreparedExperiment out{std::move(wanted), std::move(directory), {}, 1, {}, {}};
    out.runs = RunPlan(out.experiment, out.directory, plugins);
    out.sources = read_all(out.runs, diagnostics);
    if (exercise && out.experiment.exercise) {
        RunInput start;
        start.system = out.experiment.exercise->start;
        const Sources begun = read_sources(start, diagnostics);
        const auto& own = out.sources.begin()->second.system;
        if (begun.system && own) check_own(out.experiment, *begun.system, *own, diagnostics);
        if (diagnostics.failed()) return std::nullopt;
    }
    check_experiment(
        out.experiment, [&](const RunSpec& spec, Diagnostics& d) { return out.prepare(spec, d); }, out.runs,
        diagnostics);
    if (exercise && !diagnostics.failed()) findings(out, {}, diagnostics);  // checks the names
    if (diagnostics.failed()) return std::nullopt;
    return out;
}

std::optional<PreparedExperiment> prepare_experiment(model::Experiment wanted, std::string directory,
                                                     const std::vector<std::string>& plugins,
                                                     Diagnostics& diagnostics, bool exercise) {
    auto out = plan_experiment(std::move(wanted), std::move(directory), plugins, diagnostics, exercise);
    if (!out) return out;
    const char* hint = "choose another directory for the results with -o";
    try {
        make_directory(out->directory + "/runs");
        for (const auto& table : {out->results_file(), out->summary_file(), out->trials_file()})
            check_regular_file(table);
        hint = held_hint;
        out->hold = DirectoryHold(out->directory);
        if (out->experiment.adaptation) read_results(*out);  // folders of later rounds belong to it, too
        report_leftovers(*out, diagnostics);
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what(), hint);
        return std::nullopt;
    }
    return out;
}

std::optional<PreparedExperiment> prepare_experiment(const std::string& file, std::string directory,
                                                     const std::vector<std::string>& plugins,
                                                     Diagnostics& diagnostics, const std::string& system) {
    auto wanted = xml::read_experiment(file, diagnostics);
    if (!wanted) return std::nullopt;
    if (!system.empty()) wanted = with_system(std::move(*wanted), system);
    return prepare_experiment(std::move(*wanted), directory_of(file, directory), plugins, diagnostics,
                              !system.empty());
}

std::optional<PreparedExperiment> prepare_part(const std::string& file, std::string directory,
                                               const std::vector<std::string>& plugins,
                                               Diagnostics& diagnostics) {
    auto wanted = xml::read_experiment(file, diagnostics);
    if (!wanted) return std::nullopt;
    return prepare_part(std::move(*wanted), directory_of(file, directory), plugins, diagnostics);
}

std::optional<PreparedExperiment> prepare_part(model::Experiment wanted, std::string directory,
                                               const std::vector<std::string>& plugins,
                                               Diagnostics& diagnostics) {
    auto out = plan_experiment(std::move(wanted), std::move(directory), plugins, diagnostics);
    if (!out) return out;
    try {
        make_directory(out->directory);
        for (const auto& table : {out->results_file(), out->summary_file(), out->trials_file()})
            check_regular_file(table);
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what(), "choose another directory for the results with -o");
        return std::nullopt;
    }
    return out;
}

namespace {

/// The results of the runs that are planned.
PartResults read_planned(const PreparedExperiment& e, const std::optional<Shard>& only) {
    PartResults out = read_parts(e.directory, e.runs, e.experiment, only);
    if (!has_runs(e.directory)) return out;
    for (std::size_t i = only ? only->number - 1 : 0; i < e.runs.size(); i += only ? only->of : 1) {
        if (out.results[i] && out.results[i]->failure.empty()) continue;
        const PlannedRun run = e.runs[i];
        if (auto result = read_result(run, key_of(run, e.experiment)))
            out.results[i] = std::move(result), out.lines[i] = {};
    }
    return out;
}

/// Leaves the runs of the first round. Later rounds are decided again, because failed runs may have got
/// numbers.
void begin_rounds(PreparedExperiment& e) {
    if (!e.experiment.adaptation) return;
    e.runs = e.runs.with_seeds(std::vector(e.runs.combinations(), e.experiment.seeds.size()));
    e.round = 1;
}

/// Plans the next round if there is one.
bool add_round(PreparedExperiment& e, std::vector<std::optional<RunResult>>& results) {
    const auto seeds = next_round(e.experiment, e.runs, results);
    if (!seeds) return false;
    RunPlan later = e.runs.with_seeds(*seeds);
    results = carry_over(e.runs, std::move(results), later);
    e.runs = std::move(later), ++e.round;
    return true;
}

}  // namespace

PartResults read_results(PreparedExperiment& e, const std::optional<Shard>& only) {
    // What the next round is depends on the results of all parts.
    const auto wanted = e.experiment.adaptation ? std::nullopt : only;
    begin_rounds(e);
    PartResults out = read_planned(e, wanted);
    while (add_round(e, out.results)) out = read_planned(e, wanted);
    return out;
}

InputFiles input_files(const std::string& file, const PreparedExperiment& e) {
    InputFiles out = {{file, file_digest(file)}};
    std::set<std::string> done;
    for (std::size_t c = 0; c < e.runs.combinations(); ++c)
        if (done.insert(e.runs.system(c)).second)
            out.merge(input_files(e.runs[e.runs.first(c)].spec, e.sources.at(e.runs.system(c))));
    return out;
}

std::vector<std::string> result_files(const PreparedExperiment& e) {
    namespace fs = std::filesystem;
    std::vector<std::string> out;
    for (const auto& file : fs::directory_iterator(e.directory)) {
        const std::string name = file.path().filename().string();
        if (file.is_regular_file() &&
            (name.starts_with("results.") || name == "summary.csv" || name == trials_file()))
            out.push_back(name);
    }
    for (std::size_t i = 0; i < e.runs.size(); ++i) {
        const std::string run = "runs/" + e.runs.name(i);
        std::error_code none;
        for (const auto& file : fs::directory_iterator(e.directory + "/" + run, none))
            if (file.is_regular_file()) out.push_back(run + "/" + file.path().filename().string());
    }
    std::ranges::sort(out);
    return out;
}

std::vector<std::size_t> open_runs(const PartResults& found) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < found.results.size(); ++i)
        if (!found.results[i] || !found.results[i]->failure.empty()) out.push_back(i);
    return out;
}

std::optional<std::vector<RunResult>> run_experiment(PreparedExperiment& e, int jobs, bool fresh,
                                                     const ExperimentCallbacks& callbacks) {
    for (const auto& table : {e.results_file(), e.summary_file()})  // an existing table is complete
        std::remove(table.c_str());
    if (fresh) forget_parts(e.directory);
    const PrepareRun prepare = [&](const RunSpec& spec, Diagnostics& d) { return e.prepare(spec, d); };
    begin_rounds(e);
    std::vector<std::optional<RunResult>> made(e.runs.size());
    PartResults found;
    do {
        found = {};
        found.results.resize(e.runs.size()), found.lines.resize(e.runs.size());
        if (!fresh) found = read_planned(e, {});
        for (std::size_t i = 0; i < made.size(); ++i)
            if (!made[i] && found.results[i] && found.results[i]->failure.empty())
                made[i] = std::move(found.results[i]);
        RunBlock block{e.experiment, prepare, e.runs, {}};
        for (std::size_t i = 0; i < made.size(); ++i)
            if (!made[i]) block.open.push_back(i);
        block.earlier = e.runs.size() - block.open.size();
        if (e.experiment.adaptation) block.round = e.round;
        if (!execute_runs(
                block, jobs > 0 ? jobs : cores(),
                [&](std::size_t run, RunResult&& result, const std::string&) {
                    made[run] = std::move(result), found.lines[run] = {};
                },
                callbacks))
            return std::nullopt;
    } while (add_round(e, made));
    auto results = all_of(made);
    write_tables(e, *results, found);
    return results;
}

PartOutcome run_part(const PreparedExperiment& e, PartFile& file, std::vector<std::size_t> wanted, int jobs,
                     const ExperimentCallbacks& callbacks) {
    const PrepareRun prepare = [&](const RunSpec& spec, Diagnostics& d) { return e.prepare(spec, d); };
    RunBlock block{e.experiment, prepare, e.runs, std::move(wanted), 0, e.parts_leave_files()};
    PartOutcome out;
    if (block.open.empty()) return out.finished = true, out;
    const RunKeys keys(e.runs, e.experiment);
    out.finished = execute_runs(
        block, jobs > 0 ? jobs : cores(),
        [&](std::size_t run, RunResult&& result, const std::string& trials) {
            const std::string name = e.runs.name(run);
            file.add(name, keys[run], result, trials);
            ++out.runs;
            if (!result.failure.empty()) out.failures.emplace_back(name, result.failure);
        },
        callbacks);
    return out;
}

PartOutcome run_part(PreparedExperiment& e, const Shard& shard, int jobs, bool fresh,
                     const ExperimentCallbacks& callbacks) {
    if (fresh) forget_parts(e.directory, shard);
    PartResults found;
    found.results.resize(e.runs.size());
    if (!fresh) found = read_results(e, shard);
    std::vector<std::size_t> wanted;
    for (const std::size_t run : open_runs(found))
        if (run % shard.of == shard.number - 1) wanted.push_back(run);
    PartFile file(e.directory, shard.name());
    return run_part(e, file, std::move(wanted), jobs, callbacks);
}

std::optional<std::vector<RunResult>> merge(PreparedExperiment& e, Diagnostics& diagnostics) {
    PartResults found = read_results(e);
    if (found.damaged > 0)
        diagnostics.warning({},
                            fmt::format("{} lines in '{}/parts' cannot be read", found.damaged, e.directory),
                            "they count as runs that were not executed");
    const auto missing = std::ranges::count_if(found.results, [](const auto& r) { return !r; });
    if (missing > 0) {
        const auto first = std::ranges::find_if(found.results, [](const auto& r) { return !r; });
        diagnostics.error(
            {},
            fmt::format("{}{} of {} runs have no result yet, such as '{}'",
                        e.experiment.adaptation ? fmt::format("round {}: ", e.round) : "", missing,
                        e.runs.size(), e.runs.name(static_cast<std::size_t>(first - found.results.begin()))),
            fmt::format("start the {}parts again; without --merge, the runs are executed here",
                        e.experiment.adaptation ? "" : "missing "));
        return std::nullopt;
    }
    auto results = all_of(found.results);
    write_tables(e, *results, found);
    return results;
}

std::vector<Finding> findings(const PreparedExperiment& e, std::span<const RunResult> results,
                              Diagnostics& diagnostics) {
    RunSpec bare;  // names the groups and connections of the system
    bare.input = e.runs[0].spec.input;
    const auto example = e.prepare(bare, diagnostics);
    if (!example) return {};
    return findings(e.experiment, results, example->run.system(), example->run.layout(), diagnostics);
}

}  // namespace forage
