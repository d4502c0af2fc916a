#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/named_file.h"
#include "core/base/output_files.h"
#include "core/base/table.h"
#include "core/observe/recording.h"
#include "tools/forage/commands.h"
#include "tools/plot/plots.h"
#include "tools/plot/structure.h"
#include "tools/plot/trajectory.h"

namespace forage::tool {
namespace {

namespace fs = std::filesystem;
using plot::PlotSpec;
using plot::RowPlot;
using Kind = PlotSpec::Kind;

/// The source of pictures: results, a recording or a system.
struct Source {
    struct Entry {
        std::unique_ptr<observe::Recording> rows;
        observe::Recorded what;  ///< with the name and label from run.json
    };
    std::vector<Entry> recordings;
    RunInput input;  ///< the system and world of the run, if they are known
    plot::PlotContext context;
    std::string directory;  ///< the directory of results; empty when there is none
};

nlohmann::json read_json(const fs::path& path) {
    std::ifstream in(path);
    return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
}

/// A table of a run, after its header. Throws FileError.
TableReader open_table(const fs::path& path) {
    TableReader out(open_file(path.string()), path.string());
    if (!out.read_header()) out.require_whole(), out.refuse("it is empty");
    return out;
}

std::string base(const std::string& path) { return fs::path(path).filename().string(); }

/// The description of a file with one source, from run.json.
struct Named {
    std::string source, label;
    int count = 0;
};

/// The content of run.json about the files beside it.
std::map<std::string, Named> read_run(const fs::path& directory, Source& out) {
    std::map<std::string, Named> names;
    const auto json = read_json(directory / "run.json");
    if (!json.is_object()) return names;
    const auto text = [](const nlohmann::json& j, const char* key) {
        return j.is_object() && j.contains(key) && j[key].is_string() ? j[key].get<std::string>()
                                                                      : std::string();
    };
    out.input.system = text(json.value("system", nlohmann::json()), "file");
    const auto world = json.value("world", nlohmann::json());
    out.input.world = text(world, "file");
    out.input.seed = json.value("seed", std::uint64_t{1});
    for (const auto& s : json.value("set", nlohmann::json::array()))
        if (s.is_string()) out.input.settings.push_back({s.get<std::string>()});
    out.input.lenient = json.value("lenient", false);
    if (world.is_object()) out.context.seconds_per_cycle = world.value("seconds_per_cycle", 0.0);
    out.context.run =
        fmt::format("{}{}, seed {}", base(out.input.system),
                    out.input.world.empty() ? "" : " in " + base(out.input.world), out.input.seed);
    for (const auto& r :
         json.value("result", nlohmann::json::object()).value("recordings", nlohmann::json::array()))
        names[text(r, "file")] = {text(r, "source"), text(r, "label"), names[text(r, "file")].count + 1};
    if (fs::exists(directory / "trials.csv")) {
        TableReader trials = open_table(directory / "trials.csv");
        const auto first = trials.column("first_cycle");
        while (trials.next()) out.context.trials.push_back(trials.number(trials.fields()[first]));
        trials.require_whole();
    }
    return names;
}

void add_recording(const fs::path& path, const std::map<std::string, Named>& names, Source& out) {
    auto all = observe::open_recording(path.string());
    const auto known = names.find(path.filename().string());
    for (auto& r : all) {
        observe::Recorded what = r->what();
        if (known != names.end() && known->second.count == 1 && all.size() == 1)
            what.name = known->second.source, what.label = known->second.label;
        out.recordings.push_back({std::move(r), std::move(what)});
    }
}

Source open(const std::string& path) {
    Source out;
    if (fs::is_directory(path)) {
        out.directory = path;
        const auto names = read_run(path, out);
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(path)) {
            const std::string name = entry.path().filename().string();
            const bool recording =
                observe::is_recording(name) && !name.starts_with("trials") && !name.starts_with("trajectory");
            if (recording && entry.is_regular_file()) files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        for (const auto& f : files) add_recording(f, names, out);
    } else if (const auto end = fs::path(path).extension(); end == ".iqr" || end == ".iqrProcess") {
        out.input.system = path;
        out.context.run = base(path);
    } else {
        const auto names = read_run(fs::path(path).parent_path(), out);
        add_recording(path, names, out);
    }
    return out;
}

/// The recording and its part that a picture shows; -1 when there is none.
int find_recording(const Source& source, const PlotSpec& wish, std::optional<observe::Part>& part) {
    const auto matches = [&](std::string_view wanted, const std::string& name) {
        return wanted == name || wanted == name.substr(0, name.rfind(':')) || file_name(wanted) == name ||
               file_name(wanted) + "_act" == name;
    };
    const auto wanted = expression::parse_source(wish.what);
    for (std::size_t i = 0; i < source.recordings.size(); ++i) {
        const observe::Recorded& what = source.recordings[i].what;
        if (wish.what.empty() ? source.recordings.size() == 1
                              : matches(wish.what, what.name) || matches(wanted.text(), what.name))
            part = observe::part_of(what, {});  // exactly what was recorded
        else if (matches(wanted.column.text, what.name))
            part = observe::part_of(what, wanted);
        if (part) return static_cast<int>(i);
    }
    return -1;
}

void draw_rows(const Source& source, const PlotSpec& wish, const std::string& directory, plot::Format format,
               std::vector<std::string>& written, Diagnostics& diagnostics) {
    std::optional<observe::Part> part;
    const int index = find_recording(source, wish, part);
    if (index < 0) {
        std::vector<std::string> names;
        for (const auto& r : source.recordings) names.push_back(r.what.name);
        diagnostics.error({}, fmt::format("'{}': there is no such recording", wish.text),
                          names.empty()
                              ? "'forage run --record' makes recordings, 'forage run --plot' draws at once"
                              : fmt::format("there are '{}'", fmt::join(names, "', '")));
        return;
    }
    RowPlot drawn(wish, part->what);
    auto& recording = *source.recordings[static_cast<std::size_t>(index)].rows;
    std::vector<double> row, taken(part->what.size());
    recording.rewind();
    for (std::uint64_t cycle = 0; recording.next(cycle, row);) {
        part->take(row, taken);
        drawn.add(cycle, taken);
    }
    const std::string picture = drawn.draw(format, source.context);
    make_directory(directory);
    write_file(directory + "/" + wish.file(format), picture);
    written.push_back(wish.file(format));
}

/// The paths of all trials. Throws FileError for tables that are damaged or do not belong together.
std::vector<plot::Path> read_paths(const fs::path& directory) {
    std::vector<plot::Path> out;
    TableReader trials = open_table(directory / "trials.csv");
    for (const auto column = trials.column("outcome"); trials.next();) {
        const auto outcome = trials.fields()[column];
        if (outcome != "target" && outcome != "missed" && outcome != "unfinished")
            trials.fault(outcome, fmt::format("'{}' is no outcome of a trial", escaped(outcome)));
        out.push_back({{}, outcome == "target", outcome != "unfinished"});
    }
    trials.require_whole();
    TableReader points = open_table(directory / "trajectory.csv");
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

std::vector<std::string> usual_wishes(const Source& source) {
    std::vector<std::string> out;
    if (source.recordings.empty() && source.directory.empty()) return {"diagram"};
    for (const auto& r : source.recordings) {
        out.push_back("time:" + r.what.name);
        if (!r.what.mean && r.what.cells.width > 1 && r.what.cells.height > 1)
            out.push_back("space:" + r.what.name);
    }
    if (!source.directory.empty() && fs::exists(source.directory + "/trajectory.csv"))
        out.push_back("trajectory");
    return out;
}

}  // namespace

int plot(const PlotOptions& o) {
    Diagnostics diagnostics;
    std::vector<std::string> written;
    const auto say = [&] {
        for (const auto& w : written) fmt::print("{}\n", w);
        fmt::print(stderr, "{}", format(diagnostics));
        return diagnostics.failed() ? bad_input : fine;
    };
    Source source;
    try {
        std::error_code none;
        if (const auto wrong = why_unreadable(o.source); wrong && !fs::is_directory(o.source, none))
            throw FileError(o.source, {}, {*wrong});
        source = open(o.source);
    } catch (const FileError& e) {
        report(e, diagnostics);
        return say();
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what(),
                          "name a directory of results, a recording (.csv, .npy, .h5) or a system (.iqr)");
        return say();
    }
    std::vector<PlotSpec> wishes;
    bool structure = false, trajectory = false;
    for (const auto& text : o.plots.empty() ? usual_wishes(source) : o.plots)
        if (auto wish = plot::parse_plot(text, "forage plot", diagnostics)) {
            structure |= wish->kind == Kind::diagram || wish->kind == Kind::connection;
            trajectory |= wish->kind == Kind::trajectory;
            wishes.push_back(std::move(*wish));
        }
    if (wishes.empty() && !diagnostics.failed())
        diagnostics.error({}, fmt::format("there is nothing to draw in '{}'", o.source),
                          "'forage run --record' makes recordings, 'forage run --plot' draws at once");
    std::optional<Loaded> loaded;
    if ((structure || trajectory) && !diagnostics.failed()) {
        if (source.input.system.empty())
            diagnostics.error({}, "which system? there is no run.json that names it",
                              "name the .iqr file instead");
        else if (!trajectory)
            source.input.world.clear();
        if (!source.input.system.empty()) loaded = load(source.input, diagnostics);
        for (const auto& w : wishes)
            if (loaded) plot::check_structure(w, loaded->system, "forage plot", diagnostics);
        if (loaded && trajectory && (!loaded->world || !fs::exists(source.directory + "/trajectory.csv")))
            diagnostics.error({}, "a trajectory needs the results of a run in a world");
    }
    if (diagnostics.failed()) return say();

    const plot::Format format = *plot::format_of("x." + o.plot_format);
    const std::string beside = fs::path(o.source).parent_path().string();
    const std::string directory = !o.directory.empty()                          ? o.directory
                                  : !source.directory.empty()                   ? source.directory
                                  : source.recordings.empty() || beside.empty() ? "."
                                                                                : beside;
    for (const auto& w : wishes) try {
            if (w.of_cells()) {
                draw_rows(source, w, directory, format, written, diagnostics);
                continue;
            }
            const plot::Picture picture =
                w.kind == Kind::trajectory
                    ? plot::trajectory_plot(*loaded->world, read_paths(source.directory), source.context.run)
                    : plot::structure_plot(w, loaded->system, loaded->registry, nullptr, source.input.seed,
                                           source.context.run);
            make_directory(directory);
            write_file(directory + "/" + w.file(format), plot::render(picture, format));
            written.push_back(w.file(format));
        } catch (const FileError& e) {
            report(e, diagnostics);
        }
    for (auto& w : written)
        if (directory != ".") w = directory + "/" + w;
    return say();
}

}  // namespace forage::tool
