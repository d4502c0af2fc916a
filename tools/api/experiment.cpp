#include "tools/api/experiment.h"

#include <cstdio>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/base/cores.h"
#include "core/base/named_file.h"
#include "core/run/experiment/tables.h"
#include "core/xml/experiment.h"
#include "tools/api/prepare.h"

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
std::map<std::string, Sources> read_all(std::vector<PlannedRun>& runs, Diagnostics& diagnostics) {
    std::map<std::string, Sources> out;
    std::map<std::string, std::string> digests;
    for (auto& run : runs) {
        const RunInput& input = run.spec.input;
        if (!out.contains(input.system)) {
            Sources sources = out.empty() ? read_sources(input, diagnostics)
                                          : with_first_system(out.begin()->second, input, diagnostics);
            if (sources.system) digests[input.system] = source_digests(input, sources);
            out.emplace(input.system, std::move(sources));
        }
        run.files = digests[input.system];
    }
    return out;
}

/// Warns about folders of runs that are not part of the experiment any more. They are kept, as they may hold
/// the only copy of a result.
void report_leftovers(const PreparedExperiment& e, Diagnostics& diagnostics) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(e.directory + "/runs"))
        if (entry.is_directory()) names.insert(entry.path().filename().string());
    for (const auto& run : e.runs) names.erase(run.name);
    if (names.empty()) return;
    diagnostics.warning(
        {},
        fmt::format("'{}/runs' holds {} folder{} of runs that are not part of this experiment, such as '{}'",
                    e.directory, names.size(), names.size() == 1 ? "" : "s", *names.begin()),
        "tables and pictures leave them out; remove them if you do not need them");
}

}  // namespace

std::optional<PreparedRun> PreparedExperiment::prepare(const RunSpec& spec, Diagnostics& diagnostics) const {
    return forage::prepare(sources.at(spec.input.system), spec, diagnostics);
}

std::optional<PreparedExperiment> plan_experiment(model::Experiment wanted, std::string directory,
                                                  const std::vector<std::string>& plugins,
                                                  Diagnostics& diagnostics, bool exercise) {
    if (!files_are_there(wanted, diagnostics)) return std::nullopt;
    PreparedExperiment out{std::move(wanted), std::move(directory), {}, {}, {}};
    out.runs = planned_runs(out.experiment, out.directory, plugins);
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
        for (const auto& table : {out->results_file(), out->summary_file()}) check_regular_file(table);
        hint = held_hint;
        out->hold = DirectoryHold(out->directory);
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
    if (directory.empty()) directory = "forage-out/" + std::filesystem::path(file).stem().string();
    return prepare_experiment(std::move(*wanted), std::move(directory), plugins, diagnostics,
                              !system.empty());
}

std::optional<std::vector<RunResult>> run_experiment(const PreparedExperiment& e, int jobs, bool fresh,
                                                     const ExperimentCallbacks& callbacks) {
    for (const auto& table : {e.results_file(), e.summary_file()})  // an existing table is complete
        std::remove(table.c_str());
    const auto results = run_experiment(
        e.experiment, [&](const RunSpec& spec, Diagnostics& d) { return e.prepare(spec, d); }, e.runs,
        jobs > 0 ? jobs : cores(), fresh, callbacks);
    if (!results) return results;
    write_durably(e.results_file(), results_csv(e.experiment, e.runs, *results));
    write_durably(e.summary_file(), summary_csv(e.experiment, e.runs, *results));
    return results;
}

std::vector<Finding> findings(const PreparedExperiment& e, std::span<const RunResult> results,
                              Diagnostics& diagnostics) {
    RunSpec bare;  // names the groups and connections of the system
    bare.input = e.runs.front().spec.input;
    const auto example = e.prepare(bare, diagnostics);
    if (!example) return {};
    return findings(e.experiment, results, example->run.system(), example->run.layout(), diagnostics);
}

}  // namespace forage
