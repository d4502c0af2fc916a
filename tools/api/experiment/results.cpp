#include "tools/api/experiment/results.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/table.h"
#include "core/run/result_names.h"

namespace forage {
namespace {

namespace fs = std::filesystem;

/// A table of a run, after its header. Throws FileError.
TableReader open_table(const std::string& path) {
    TableReader out(open_file(path), path);
    if (!out.read_header()) out.require_whole(), out.refuse("it is empty");
    return out;
}

/// Takes what is known about the run, and what trials.csv in `directory` says. Returns the recordings.
std::vector<ResultFiles::Recording> take_run(const std::string& directory, std::optional<FinishedRun> run,
                                             Results& out) {
    if (!run) return {};
    out.input = std::move(run->input);
    out.context.run = run_title(out.input);
    out.context.seconds_per_cycle = run->seconds_per_cycle;
    if (const std::string path = directory + "/" + trials_file(); fs::exists(path)) {
        TableReader trials = open_table(path);
        const auto first = trials.column("first_cycle");
        while (trials.next()) out.context.trials.push_back(trials.number(trials.fields()[first]));
        trials.require_whole();
    }
    return std::move(run->recordings);
}

/// Whether a recording is of a connection's synapses: "Name:weight", while a group is "Process/Group".
bool is_of_synapses(const observe::Recorded& what) {
    const auto end = what.name.rfind(':');
    return !what.one_number() && end != std::string::npos && what.name.find('/') > end;
}

/// Opens a recording. A recording of a single source gets its name and label from run.json, as its own format
/// may not store them.
void add_recording(const fs::path& path, const std::vector<ResultFiles::Recording>& known, Results& out) {
    std::vector<const ResultFiles::Recording*> named;
    for (const auto& k : known)
        if (k.file == path.filename()) named.push_back(&k);
    auto all = observe::open_recording(path.string());
    for (auto& rows : all) {
        observe::Recorded what = rows->what();
        if (named.size() == 1 && all.size() == 1) what.name = named[0]->source;
        for (const auto* n : named)
            if (n->source == what.name) what.label = n->label, what.names = n->names;
        if (what.one_number() && what.name.starts_with("max:"))
            what.reduction = "max";  // a .npy file does not say which number it has
        what.synapses = is_of_synapses(what);
        out.recordings.push_back({std::move(rows), std::move(what)});
    }
}

/// The results of a run in a directory.
Results results_in(const std::string& directory, std::optional<FinishedRun> run) {
    Results out;
    out.path = out.directory = directory;
    const auto known = take_run(directory, std::move(run), out);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        const bool recording = observe::is_recording(name) && !is_of_trials(name) && !is_of_trajectory(name);
        if (recording && entry.is_regular_file()) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const auto& f : files) add_recording(f, known, out);
    return out;
}

}  // namespace

Results results_of(const std::string& directory, FinishedRun run) {
    return results_in(directory, std::move(run));
}

Results open_results(const std::string& path) {
    Results out;
    out.path = path;
    std::error_code none;
    if (!fs::is_directory(path, none))
        if (const auto wrong = why_unreadable(path)) throw FileError(path, {}, {*wrong});
    if (holds_experiment(path)) {
        out.directory = path;
        out.experiment = read_run_table(path);
        const bool runs = has_runs(path);
        for (const auto& row : out.experiment->rows) {  // all have the same world
            if (!runs) break;
            if (const auto run = read_run_json(fmt::format("{}/runs/{}", path, row.run))) {
                out.input = run->input;
                out.context.seconds_per_cycle = run->seconds_per_cycle;
                break;
            }
        }
        out.context.run = fs::weakly_canonical(path).filename().string();
    } else if (fs::is_directory(path)) {
        return results_in(path, read_run_json(path));
    } else if (const auto end = fs::path(path).extension(); end == ".iqr" || end == ".iqrProcess") {
        out.input.system = path;
        out.context.run = fs::path(path).filename().string();
    } else {
        const fs::path parent = fs::path(path).parent_path();
        const std::string directory = parent.empty() ? "." : parent.string();
        const auto known = take_run(directory, read_run_json(directory), out);
        add_recording(path, known, out);
    }
    return out;
}

std::vector<plot::Path> read_paths(const std::string& directory) {
    std::vector<plot::Path> out;
    TableReader trials = open_table(directory + "/" + trials_file());
    for (const auto column = trials.column("outcome"); trials.next();) {
        const auto outcome = trials.fields()[column];
        if (outcome != "target" && outcome != "missed" && outcome != "unfinished")
            trials.fault(outcome, fmt::format("'{}' is not an outcome of a trial", escaped(outcome)));
        out.push_back({{}, outcome == "target", outcome != "unfinished", out.size() + 1});
    }
    trials.require_whole();
    if (out.empty()) out.push_back({{}, false, false, 1});  // a world without trials has one path, no outcome
    TableReader points = open_table(directory + "/" + trajectory_file());
    const auto trial = points.column("trial"), x = points.column("x"), y = points.column("y");
    while (points.next()) {
        const auto& row = points.fields();
        const auto number = parse_number<std::size_t>(row[trial]).value_or(0);
        const Eigen::Vector2d place(points.number(row[x]), points.number(row[y]));
        if (number == 0 || number > out.size())
            points.fault(row[trial], fmt::format("trials.csv has no trial {}", escaped(row[trial])));
        else
            out[number - 1].points.push_back(place);
    }
    points.require_whole();
    return out;
}

}  // namespace forage
