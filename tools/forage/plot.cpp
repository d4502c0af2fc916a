#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/named_file.h"
#include "core/base/output_files.h"
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

/// What a person points at: results, a recording or a system.
struct Source {
    struct Entry {
        std::unique_ptr<observe::Recording> rows;
        observe::Recorded what;  ///< with the name and label that run.json knows
    };
    std::vector<Entry> recordings;
    RunInput input;  ///< the system and world that were run, as far as they are known
    plot::PlotContext context;
    std::string directory;  ///< of the results; empty when there are none
};

nlohmann::json read_json(const fs::path& path) {
    std::ifstream in(path);
    return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
}

/// A table that a run has left behind. What is damaged is refused with its place, as a FileError.
class Table {
  public:
    explicit Table(const fs::path& path) : path_(path.string()), text_(read_file(path_)) {
        std::string_view rest = text_;
        while (!rest.empty()) {
            const auto end = rest.find('\n');
            if (end == rest.npos)
                fail(static_cast<int>(lines_.size()) + 1, rest, "the file ends within this row");
            lines_.push_back(fields(rest.substr(0, end)));
            rest.remove_prefix(end + 1);
            if (lines_.back().size() != lines_[0].size())
                fail(static_cast<int>(lines_.size()), lines_.back()[0],
                     fmt::format("{} fields in this row, not {}", lines_.back().size(), lines_[0].size()));
        }
        if (lines_.empty()) throw FileError(path_, {}, {error_at(0, 0, "it is empty")});
    }

    int rows() const { return static_cast<int>(lines_.size()) - 1; }
    /// What stands in a row, counted from 1, under a name.
    std::string_view word(int row, std::string_view name) const {
        const auto column = std::find(lines_[0].begin(), lines_[0].end(), name);
        if (column == lines_[0].end()) fail(1, lines_[0][0], fmt::format("there is no column '{}'", name));
        return lines_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column - lines_[0].begin())];
    }
    double number(int row, std::string_view name) const {
        const std::string_view text = word(row, name);
        double out = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(out))
            fail(row + 1, text, no_number(text));
        return out;
    }
    /// A piece of the text in this line is not what it should be.
    [[noreturn]] void fail(int line, std::string_view piece, std::string message) const {
        const auto place = static_cast<std::size_t>(piece.data() - text_.data());
        const auto begin = place == 0 ? 0 : text_.rfind('\n', place - 1) + 1;  // 0 in the first line
        throw FileError(path_, text_, {error_at(line, static_cast<int>(place - begin) + 1, std::move(message))});
    }

  private:
    static std::vector<std::string_view> fields(std::string_view line) {
        std::vector<std::string_view> out;
        for (auto comma = line.find(','); comma != line.npos; comma = line.find(',')) {
            out.push_back(line.substr(0, comma));
            line.remove_prefix(comma + 1);
        }
        out.push_back(line);
        return out;
    }

    std::string path_, text_;
    std::vector<std::vector<std::string_view>> lines_;  ///< the first holds the names of the columns
};

std::string base(const std::string& path) { return fs::path(path).filename().string(); }

/// What run.json says of a file that holds one source.
struct Named {
    std::string source, label;
    int count = 0;
};

/// What run.json says of the files beside it.
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
        const Table trials(directory / "trials.csv");
        for (int row = 1; row <= trials.rows(); ++row)
            out.context.trials.push_back(trials.number(row, "first_cycle"));
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

/// Which recording a wish means, and which part of it; -1 when none.
int find_recording(const Source& source, const PlotSpec& wish, std::optional<observe::Part>& part) {
    const auto matches = [&](std::string_view wanted, const std::string& name) {
        return wanted == name || wanted == name.substr(0, name.rfind(':')) || file_name(wanted) == name ||
               file_name(wanted) + "_act" == name;
    };
    const auto selection = observe::parse_selection(wish.what);
    for (std::size_t i = 0; i < source.recordings.size(); ++i) {
        const observe::Recorded& what = source.recordings[i].what;
        if (wish.what.empty() ? source.recordings.size() == 1 : matches(wish.what, what.name))
            part = observe::part_of(what, {});  // exactly what was recorded
        else if (matches(selection.column, what.name))
            part = observe::part_of(what, selection);
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
std::vector<plot::Path> read_paths(const std::string& directory) {
    const Table trials(directory + "/trials.csv"), points(directory + "/trajectory.csv");
    std::vector<plot::Path> out(static_cast<std::size_t>(trials.rows()));
    for (int row = 1; row <= trials.rows(); ++row) {
        const std::string_view outcome = trials.word(row, "outcome");
        if (outcome != "target" && outcome != "missed" && outcome != "unfinished")
            trials.fail(row + 1, outcome, fmt::format("'{}' is no outcome of a trial", escaped(outcome)));
        out[static_cast<std::size_t>(row) - 1].reached = outcome == "target";
        out[static_cast<std::size_t>(row) - 1].finished = outcome != "unfinished";
    }
    for (int row = 1; row <= points.rows(); ++row) {
        const double trial = points.number(row, "trial");
        if (trial < 1 || trial > trials.rows() || trial != std::floor(trial))
            points.fail(row + 1, points.word(row, "trial"),
                        fmt::format("trials.csv has no trial {}", points.word(row, "trial")));
        out[static_cast<std::size_t>(trial) - 1].points.emplace_back(points.number(row, "x"),
                                                                     points.number(row, "y"));
    }
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
    for (const auto& w : wishes) {
        if (w.of_cells()) {
            try {
                draw_rows(source, w, directory, format, written, diagnostics);
            } catch (const FileError& e) {
                report(e, diagnostics);
            }
            continue;
        }
        try {
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
    }
    for (auto& w : written)
        if (directory != ".") w = directory + "/" + w;
    return say();
}

}  // namespace forage::tool
