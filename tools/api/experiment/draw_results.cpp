#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/base/output_files.h"
#include "core/base/separated.h"
#include "core/run/result_names.h"
#include "tools/api/experiment/results.h"
#include "tools/api/open/sources.h"
#include "tools/plot/occupancy.h"
#include "tools/plot/structure.h"

namespace forage {
namespace {

namespace fs = std::filesystem;
using plot::PlotSpec;
using Kind = PlotSpec::Kind;

constexpr const char* how_to_record =
    "'forage run --record' makes recordings, 'forage run --plot' draws at once";

std::vector<std::string> usual_plots(const Results& results) {
    if (results.experiment) return usual_plots(*results.experiment, results.directory);
    std::vector<std::string> out;
    if (results.recordings.empty() && results.directory.empty()) return {"diagram"};
    for (const auto& r : results.recordings) {
        out.push_back("time:" + r.what.name);
        if (!r.what.one_number() && r.what.cells.width > 1 && r.what.cells.height > 1)
            out.push_back("space:" + r.what.name);
    }
    if (!results.directory.empty() && fs::exists(results.directory + "/" + trajectory_file()))
        out.emplace_back("trajectory");
    return out;
}

/// The recording that a plot refers to, and the part of it; null when there is none.
const Results::Entry* find_recording(const Results& results, const PlotSpec& spec,
                                     const expression::Source& wanted, std::optional<observe::Part>& part) {
    const auto matches = [](std::string_view text, const std::string& name) {
        return text == name || text == name.substr(0, name.rfind(':')) || file_name(text) == name ||
               file_name(text) + "_act" == name;
    };
    for (const auto& entry : results.recordings) {
        const std::string& name = entry.what.name;
        if (spec.what.empty() ? results.recordings.size() == 1
                              : matches(spec.what, name) || matches(wanted.text(), name))
            part = observe::part_of(entry.what, {});  // exactly what was recorded
        else if (matches(wanted.column.text, name))
            part = observe::part_of(entry.what, wanted);
        if (part) return &entry;
    }
    return nullptr;
}

/// The plot of recorded rows; reports an error and returns nothing when there is no such recording.
std::optional<plot::RowPlot> draw_rows(const Results& results, const PlotSpec& spec,
                                       const std::optional<Loaded>& loaded, Diagnostics& diagnostics) {
    const auto wanted =
        expression::Context{spec.source(), "forage plot", diagnostics}.parsed(&expression::parse_source);
    if (!wanted) return std::nullopt;
    if (results.experiment) {
        diagnostics.error({}, fmt::format("'{}': the recordings are those of the runs", spec.text),
                          fmt::format("draw that of a run: forage plot '{}/runs/{}' '{}'", results.directory,
                                      results.experiment->rows.front().run, spec.text));
        return std::nullopt;
    }
    std::optional<observe::Part> part;
    const auto* entry = find_recording(results, spec, *wanted, part);
    if (!entry) {
        PlotSpec inside = spec;  // of "max(Process/Group)"
        if (const auto open = spec.what.find('(');
            wanted->reduction.empty() && open != std::string::npos && spec.what.ends_with(')')) {
            inside.what = spec.what.substr(open + 1, spec.what.size() - open - 2);
            if (find_recording(results, inside, *wanted, part)) {
                diagnostics.error({},
                                  fmt::format("'{}': '{}' is not a function of cells here", spec.text,
                                              spec.what.substr(0, open)),
                                  "sources have mean(...) and max(...), conditions also sum and min");
                return std::nullopt;
            }
        }
        std::vector<std::string> names;
        for (const auto& r : results.recordings) names.push_back(r.what.name);
        diagnostics.error(
            {}, fmt::format("'{}': there is no such recording", spec.text),
            names.empty() ? how_to_record : fmt::format("there are '{}'", separated(names, "', '")));
        return std::nullopt;
    }
    plot::RowPlot drawn(spec, part->what, loaded ? &loaded->system : nullptr);
    std::vector<double> row, taken(part->what.size());
    entry->rows->rewind();
    for (std::uint64_t cycle = 0; entry->rows->next(cycle, row);) {
        part->take(row, taken);
        drawn.add(cycle, taken);
    }
    if (const auto missing = drawn.missing(); !missing.empty())
        diagnostics.warning({}, fmt::format("'{}': the recording ends before cycle {}", spec.text, missing),
                            fmt::format("its last cycle is {}", drawn.last()));
    return drawn;
}

/// The runs of an experiment, or the one whose results these are.
std::vector<RunSeries> runs_of(const Results& results) {
    if (results.experiment) return run_series(*results.experiment, results.directory);
    return {{"", {results.directory}}};
}

/// Which part of the runs the pictures of an experiment show.
std::string part_of(const Results& results) {
    return results.experiment ? results.experiment->part : std::string();
}

/// Where the robot was in all runs, by condition. Reports results without paths.
std::optional<plot::Picture> draw_occupancy(const Results& results, const bug::World& world,
                                            Diagnostics& diagnostics) {
    std::vector<plot::PathsOf> conditions;
    for (const auto& series : runs_of(results)) {
        plot::PathsOf condition{series.name, {}};
        for (const auto& directory : series.directories)
            if (fs::exists(directory + "/" + trajectory_file()))
                for (auto& path : read_paths(directory)) condition.paths.push_back(std::move(path));
        if (!condition.paths.empty()) conditions.push_back(std::move(condition));
    }
    if (conditions.empty())
        diagnostics.error({}, fmt::format("'{}' holds no paths of a robot", results.path),
                          results.experiment ? "write <plot what=\"trajectory\"/> in the experiment"
                                             : "runs in a world have a trajectory.csv");
    else if (conditions.size() > plot::max_maps)
        diagnostics.error(
            {}, fmt::format("'occupancy': {} conditions are too many for a picture", conditions.size()),
            "draw some of them, with --where 'PARAMETER=VALUE'");
    else
        return plot::occupancy_plot(world, conditions, results.context.run, part_of(results));
    return std::nullopt;
}

/// The paths of a run. Reports trials that it does not have.
std::optional<plot::Picture> draw_trajectory(const PlotSpec& spec, const bug::World& world,
                                             const Results& results, Diagnostics& diagnostics) {
    auto paths = read_paths(results.directory);
    const auto missing = spec.after(paths.size()), hint = plot::count_of_trials(paths.size());
    paths = plot::wanted_paths(std::move(paths), spec);
    if (paths.empty() && !spec.cycles.empty()) {
        diagnostics.error({}, fmt::format("'{}': there are no trials {}", spec.text, spec.cycles_text), hint);
        return std::nullopt;
    }
    if (!missing.empty())
        diagnostics.warning({}, fmt::format("'{}': the run ended before trial {}", spec.text, missing), hint);
    return plot::trajectory_plot(world, std::move(paths), results.context.run);
}

/// Loads what the pictures of a system and of its world need. Empty when no picture needs it, and when
/// something is missing, which is reported.
std::optional<Loaded> load_for(const std::vector<PlotSpec>& specs, const Results& results,
                               Diagnostics& diagnostics) {
    const auto any = [&](auto... kinds) {
        return std::ranges::any_of(specs, [&](const PlotSpec& s) { return ((s.kind == kinds) || ...); });
    };
    const bool trajectory = any(Kind::trajectory), world = trajectory || any(Kind::occupancy);
    if (!world && !any(Kind::diagram, Kind::connection, Kind::wiring)) return std::nullopt;
    if (results.input.system.empty()) {
        diagnostics.error({}, "which system? there is no run.json that names it",
                          "name the .iqr file instead");
        return std::nullopt;
    }
    RunInput input = results.input;
    if (!world) input.world.clear();
    auto loaded = load(input, diagnostics);
    if (!loaded) return loaded;
    for (const auto& s : specs) plot::check_structure(s, loaded->system, "forage plot", diagnostics);
    if (trajectory && (!loaded->world || !fs::exists(results.directory + "/" + trajectory_file())))
        diagnostics.error({}, "a trajectory needs the results of a run in a world");
    return loaded;
}

/// A picture that is not of recorded rows; empty when there was an error.
std::optional<plot::Picture> draw_other(const PlotSpec& spec, Results& results,
                                        const std::optional<Loaded>& loaded, Diagnostics& diagnostics) {
    const std::string& title = results.context.run;
    std::optional<plot::Picture> picture;
    if (spec.kind == Kind::learning)
        picture = draw_learning(spec, runs_of(results),
                                results.experiment ? results.directory + "/" + trials_file() : "", title,
                                part_of(results), diagnostics);
    else if (spec.kind == Kind::occupancy && !loaded->world)
        diagnostics.error({}, fmt::format("'{}': these runs have no world", spec.text));
    else if (spec.kind == Kind::occupancy)
        picture = draw_occupancy(results, *loaded->world, diagnostics);
    else if (spec.of_results() && !results.experiment)
        diagnostics.error(
            {}, fmt::format("'{}': '{}' does not hold the results of an experiment", spec.text, results.path),
            "'forage experiment' writes them");
    else if (spec.of_results())
        picture = draw_measure(spec, *results.experiment, title, diagnostics);
    else if (spec.kind == Kind::trajectory)
        picture = draw_trajectory(spec, *loaded->world, results, diagnostics);
    else
        picture =
            plot::structure_plot(spec, loaded->system, loaded->registry, nullptr, results.input.seed, title);
    return picture;
}

/// A picture that is no animation; empty when there was an error.
std::optional<plot::Picture> draw_picture(const PlotSpec& spec, Results& results,
                                          const std::optional<Loaded>& loaded, Diagnostics& diagnostics) {
    if (!spec.of_cells()) return draw_other(spec, results, loaded, diagnostics);
    std::optional<plot::RowPlot> rows;
    for (const auto& source : spec.sources()) {
        PlotSpec one = spec;
        if (spec.kind == Kind::time) one.what = source;
        auto some = draw_rows(results, one, loaded, diagnostics);
        if (!some) return std::nullopt;
        if (rows)
            rows->join(std::move(*some));
        else
            rows = std::move(some);
    }
    return rows->picture(results.context);
}

std::string render(const plot::Picture& picture, const std::optional<plot::FigureWidth>& width,
                   plot::Format format) {
    return plot::render(width ? plot::scaled(picture, *width, format) : picture, format);
}

/// A picture as the content of a file; empty when there was an error.
std::string draw_file(const PlotSpec& spec, const std::optional<plot::FigureWidth>& width, Results& results,
                      const std::optional<Loaded>& loaded, plot::Format format, Diagnostics& diagnostics) {
    if (spec.kind == Kind::movie) {
        const auto rows = draw_rows(results, spec, loaded, diagnostics);
        return rows ? rows->draw(format, results.context) : "";
    }
    const auto picture = draw_picture(spec, results, loaded, diagnostics);
    return picture ? render(*picture, width, format) : "";
}

/// The pictures as panels of one figure, as the content of a file; empty when there was an error.
std::string draw_figure(const std::vector<PlotSpec>& specs, const plot::FigureLayout& layout,
                        const std::optional<plot::FigureWidth>& width, Results& results,
                        const std::optional<Loaded>& loaded, plot::Format format, Diagnostics& diagnostics) {
    const auto places = static_cast<std::size_t>(layout.rows) * static_cast<std::size_t>(layout.columns);
    if (specs.size() > places || specs.size() > plot::max_panels_of_figure)
        diagnostics.error(
            {},
            fmt::format("{} plots do not fit into {} x {} panels", specs.size(), layout.rows, layout.columns),
            fmt::format("choose a larger --layout; a figure has at most {} panels",
                        plot::max_panels_of_figure));
    for (const auto& spec : specs)
        if (spec.kind == Kind::movie)
            diagnostics.error({}, fmt::format("'{}' is an animation, which is no panel", spec.text),
                              "'space:SOURCE@CYCLES' draws some of its cycles");
    std::vector<plot::Picture> panels;
    for (const auto& spec : specs) {
        if (diagnostics.failed()) return {};
        if (auto picture = draw_picture(spec, results, loaded, diagnostics)) panels.push_back(*picture);
    }
    if (diagnostics.failed()) return {};
    return render(plot::figure(std::move(panels), layout), width, format);
}

}  // namespace

std::vector<std::string> draw(Results& results, const std::vector<std::string>& plots, std::string directory,
                              plot::Format format, Diagnostics& diagnostics,
                              const std::vector<std::string>& where,
                              const std::optional<plot::FigureLayout>& layout,
                              const std::optional<plot::FigureWidth>& width) {
    if (results.experiment)
        keep_runs(*results.experiment, where, diagnostics);
    else if (!where.empty())
        diagnostics.error(
            {}, fmt::format("--where chooses runs of an experiment, and '{}' is none", results.path));
    if (diagnostics.failed()) return {};
    std::vector<PlotSpec> specs;
    for (const auto& text : plots.empty() ? usual_plots(results) : plots)
        if (auto spec = plot::parse_plot(text, "forage plot", diagnostics)) {
            if (spec->of_results()) spec->part = part_of(results);
            if (width && spec->kind == Kind::movie)
                diagnostics.error({}, fmt::format("'{}' is an animation, which has a size of its own", text),
                                  "leave out --width");
            specs.push_back(std::move(*spec));
        }
    if (specs.empty() && !diagnostics.failed())
        diagnostics.error({}, fmt::format("there is nothing to draw in '{}'", results.path), how_to_record);
    std::optional<Loaded> loaded;
    if (!diagnostics.failed()) loaded = load_for(specs, results, diagnostics);
    if (diagnostics.failed()) return {};

    if (directory.empty()) directory = results.directory;
    if (directory.empty() && !results.recordings.empty())
        directory = fs::path(results.path).parent_path().string();
    if (directory.empty()) directory = ".";
    std::vector<std::pair<std::string, std::string>> pictures;  // file names and contents
    std::vector<std::string> written;
    const auto attempt = [&](const auto& action) {
        try {
            action();
        } catch (const FileError& e) {
            report(e, diagnostics);
        } catch (const std::exception& e) {
            diagnostics.error({}, e.what());
        }
    };
    const auto add = [&](const std::string& name, const auto& draw_it) {
        attempt([&] { pictures.emplace_back(directory == "." ? name : directory + "/" + name, draw_it()); });
    };
    if (layout)
        add("figure" + std::string(plot::ending(format)),
            [&] { return draw_figure(specs, *layout, width, results, loaded, format, diagnostics); });
    else
        for (const auto& spec : specs)
            add(spec.file(format),
                [&] { return draw_file(spec, width, results, loaded, format, diagnostics); });
    if (diagnostics.failed()) return {};  // no picture beside a mistake
    for (const auto& [file, picture] : pictures)
        attempt([&, &file = file, &picture = picture] {
            make_directory(directory);
            write_result(file, picture);
            written.push_back(file);
        });
    return written;
}

}  // namespace forage
