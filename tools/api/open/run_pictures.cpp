// Pictures and films of a run in memory.

#include <fmt/format.h>
#include <forage/forage.h>

#include "core/observe/source.h"
#include "core/run/path_recorder.h"
#include "tools/plot/plots.h"
#include "tools/plot/structure.h"

namespace forage {
namespace {

using Kind = plot::PlotSpec::Kind;

bool same_column(const observe::Recorded& a, const observe::Recorded& b) {
    return a.group_id == b.group_id && a.group == b.group && a.state == b.state && a.synapses == b.synapses;
}

/// The recording in memory with the rows of a picture, and the part of it that is drawn; null when there is
/// none.
const MemoryRecorder* find_recorder(const Run& run, const observe::Recorded& wanted,
                                    const expression::Source& text, std::optional<observe::Part>& part) {
    for (const auto& o : run.observers()) {
        const auto* recorder = dynamic_cast<const MemoryRecorder*>(o.get());
        if (!recorder) continue;
        const auto& what = recorder->what();
        if (what.name == wanted.name)
            part = observe::part_of(what, {});
        else if (!what.one_number() && same_column(what, wanted))
            part = observe::part_of(what, text);
        if (part) return recorder;
    }
    return nullptr;
}

std::string draw_rows(Run& run, const plot::PlotSpec& spec, plot::Format format, Diagnostics& diagnostics) {
    const std::string text = spec.source();
    const auto parsed = expression::Context{text, "plot", diagnostics}.parsed(&expression::parse_source);
    const auto source = checked(diagnostics, observe::find_source(run.layout(), text, "plot", diagnostics));
    plot::RowPlot drawn(spec, source->what(), &run.system());
    std::vector<double> taken(source->what().size());
    std::optional<observe::Part> part;
    if (const auto* recorder = find_recorder(run, source->what(), *parsed, part)) {
        const auto rows = recorder->rows();
        for (Index i = 0; i < rows.rows(); ++i) {
            part->take({rows.row(i).data(), static_cast<std::size_t>(rows.cols())}, taken);
            drawn.add(recorder->cycles()[static_cast<std::size_t>(i)], taken);
        }
    } else if (spec.kind == Kind::space && spec.cycles.empty() && run.cycle() > 0) {
        drawn.add(run.cycle() - 1, run.read(text));
    } else {
        throw InputError(fmt::format("'{}': '{}' is not recorded", spec.text, source->what().name),
                         "record it in memory before the cycles that the picture shows");
    }
    std::string out = drawn.draw(format, plot::context_of(run, run.title));
    if (const auto missing = drawn.missing(); !missing.empty())
        diagnostics.warning({}, fmt::format("'{}': the recording ends before cycle {}", spec.text, missing),
                            fmt::format("its last cycle is {}", drawn.last()));
    return out;
}

std::string draw_trajectory(const Run& run, const plot::PlotSpec& spec, plot::Format format,
                            std::size_t robot, Diagnostics& diagnostics) {
    const auto* world = dynamic_cast<const bug::World*>(run.environment());
    if (!world) throw InputError("a trajectory needs a world", "open the run with a world");
    for (const auto& o : run.observers())
        if (const auto* recorder = dynamic_cast<const PathRecorder*>(o.get());
            recorder && recorder->robot() == robot) {
            auto paths = plot::paths_of(*recorder, *world);
            if (const auto missing = spec.after(paths.size()); !missing.empty())
                diagnostics.warning({},
                                    fmt::format("'{}': the run ended before trial {}", spec.text, missing),
                                    plot::count_of_trials(paths.size()));
            paths = plot::wanted_paths(std::move(paths), spec);
            return plot::render(plot::trajectory_plot(*world, std::move(paths), run.title, robot), format);
        }
    const auto robots = world->robot_names().size();
    if (robot >= robots)
        throw InputError(fmt::format("there is no robot {}", robot),
                         fmt::format("the world has {}, counted from 0", robots));
    throw InputError("this run does not keep the paths of its robots", "open it with the option paths");
}

}  // namespace

std::string draw(Run& run, const std::string& picture, const std::string& format, std::size_t robot,
                 Diagnostics* warnings) try {
    Diagnostics diagnostics;
    const auto file = plot::format_of("x." + format);
    if (!file) diagnostics.error({}, "'" + format + "' is not a format of pictures", "png, svg or pdf");
    const auto spec = plot::parse_plot(picture, "plot", diagnostics);
    if (spec && spec->of_results())
        diagnostics.error({}, fmt::format("'{}' is drawn from the results of several runs", picture),
                          "'forage plot' and forage::draw() draw it from a directory");
    throw_errors(diagnostics);
    run.start();
    std::string out;
    if (spec->of_cells()) {
        out = draw_rows(run, *spec, *file, diagnostics);
    } else if (spec->kind == Kind::trajectory) {
        out = draw_trajectory(run, *spec, *file, robot, diagnostics);
    } else {
        plot::check_structure(*spec, run.system(), "plot", diagnostics);
        throw_errors(diagnostics);
        out = plot::render(plot::structure_plot(*spec, run.system(), run.registry(), &run.simulation(),
                                                run.seed(), run.title),
                           *file);
    }
    append(warnings, diagnostics);
    return out;
} catch (const std::runtime_error& e) {
    if (dynamic_cast<const InputError*>(&e) || dynamic_cast<const engine::RunError*>(&e)) throw;
    throw InputError(e.what());
}

Observer& film(Run& run, const std::string& file, const std::vector<std::string>& groups) {
    if (!dynamic_cast<bug::World*>(run.environment()))
        throw InputError("a film needs a world", "open the run with a world");
    Diagnostics diagnostics;
    std::vector<model::Expression> sources;
    for (const auto& group : groups) sources.push_back({group});
    auto film = checked(diagnostics, plot::make_film(run, file, sources, "film", "film", diagnostics));
    return run.add(std::move(film));
}

std::size_t finish_film(Run& run, Observer& film) {
    plot::Film& file = dynamic_cast<plot::FilmRecorder&>(film).film();
    const std::size_t frames = file.finish();
    run.remove(film);
    return frames;
}

}  // namespace forage
