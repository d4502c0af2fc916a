#include "tools/forage/running.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "tools/forage/checkpoint.h"
#include "tools/forage/cores.h"
#include "tools/forage/files.h"
#include "tools/forage/length.h"
#include "tools/forage/manipulations.h"
#include "tools/forage/schedule.h"
#include "tools/forage/score.h"
#include "tools/forage/tables.h"

namespace forage::tool {
namespace {

std::string describe(const engine::NotFinite& what, const engine::Layout& layout) {
    const auto& [path, id, shape, type] = layout.groups[what.group];
    const auto place = shape.cells == shape.width * shape.height
                           ? fmt::format("({}, {})", what.cell % shape.width + 1, what.cell / shape.width + 1)
                           : fmt::format("{}", what.cell + 1);
    return fmt::format("in cycle {} '{}' of '{}' becomes {} in cell {}", what.cycle,
                       type.states[what.state].name, path, what.value, place);
}

}  // namespace

observe::SimTime Running::now() const {
    const int trial = has_trials(loaded) ? static_cast<int>(loaded.world->trials(0).size()) + 1 : 0;
    return {simulation.cycle(), seconds(), trial};
}

void Running::cycle() {
    if (schedule.waiting()) schedule.apply(simulation, now());
    if (run_measures.waiting()) run_measures.see(simulation, now());
    for (auto& m : manipulations) m.look(simulation, now());
    simulation.update_groups();
    if (simulation.not_finite() && diverged.empty())
        diverged = describe(*simulation.not_finite(), simulation.layout());
    clamp.apply(simulation);
    for (auto& m : manipulations) m.apply(simulation);
    simulation.update_modules();
    simulation.update_connections();
    if (loaded.world) loaded.world->step();
    if (recordings) recordings->record(simulation);
    plots.follow(simulation);
    for (auto& m : measures) m.follow(simulation);
    for (auto& p : paths) p.follow();
    if (film && simulation.cycle() % film_every == 0) film->add();
}

void Running::checkpoint(Archive& archive) {
    archive(simulation);
    if (loaded.world) archive(*loaded.world);
    archive(schedule);
    for (auto& m : manipulations) archive(m);
    archive(run_measures);
    for (auto& m : measures) archive(m);
    archive(plots);
    for (auto& p : paths) archive(p);
    archive(diverged);
    if (!diverged.empty()) simulation.check_finite(false);
    if (recordings) archive(*recordings);
}

std::optional<Running> prepare(const Sources& sources, const RunOptions& o, Diagnostics& diagnostics) {
    auto loaded = assemble(sources, o.input, diagnostics);
    if (!loaded) return std::nullopt;
    check_length(o, loaded->world.get(), diagnostics);
    if (!o.video.empty() && !plot::Film::is_name(o.video))
        diagnostics.error({}, fmt::format("--video: '{}' is no name of a film", o.video),
                          "it ends with .gif or .png");
    else if (!o.video.empty())
        check_output(o.video, "film.gif", diagnostics);
    if (sources.drive) check_drive(*sources.drive, loaded->system, diagnostics);
    auto layout = engine::make_layout(loaded->system, loaded->registry, diagnostics, loaded->world.get());
    if (!layout) return std::nullopt;
    auto scheduled = schedule(o.at, *loaded, *layout, diagnostics);
    std::optional<observe::Condition> until;
    if (!o.until.empty())
        until = observe::parse_condition(*layout, has_trials(*loaded), o.until.text,
                                         o.until.at.file ? "until" : "--until", diagnostics, o.until.at);
    auto clamped = clamp(o.clamp, *layout, diagnostics);
    auto manipulated = manipulations(o.manipulations, *loaded, *layout, diagnostics);
    auto files = recorded_files(o, *layout, diagnostics);
    for (const auto& wish : o.plots)
        if (!loaded->world && model::trim(wish.text) == "trajectory")
            diagnostics.error(wish.at, "a trajectory needs a world", "add --world FILE.world");
    auto plots = LivePlots::make(o.plots, loaded->system, *layout, diagnostics);
    check_checkpoints(o, *layout, diagnostics);
    RunMeasures run_measures(o.measures, *loaded, *layout, diagnostics);
    try {
        std::vector<Measures> measures;
        if (loaded->world && !diagnostics.failed())
            for (std::size_t i = 0; i < loaded->world->bugs(); ++i)
                measures.emplace_back(*loaded->world, i, *layout);
        engine::Demand demand;
        scheduled.declare(demand);
        if (until) until->declare(demand);
        clamped.declare(demand);
        for (const auto& m : manipulated) m.declare(demand);
        for (const auto& f : files)
            for (const auto& s : f.sources) s.declare(demand);
        plots.declare(demand);
        run_measures.declare(demand);
        for (const auto& m : measures) m.declare(demand);
        if (o.hash) demand.read_everything();  // a digest is one of all numbers

        auto simulation = engine::Simulation::build(
            loaded->system, std::move(*layout), demand,
            {.seed = o.input.seed,
             .threads = std::min(o.threads, cores()),
             .environment = loaded->world.get()}, diagnostics);
        if (!simulation) return std::nullopt;
        scheduled.check(*simulation, diagnostics);
        run_measures.check(*simulation, diagnostics);
        if (diagnostics.failed()) return std::nullopt;
        simulation->start();
        simulation->check_finite(o.on_nan != OnNan::ignore);
        const double seconds_per_cycle =
            loaded->world ? loaded->world->seconds_per_cycle() : 1 / cycles_per_second(loaded->system);
        Running out{{},
                    std::move(*loaded),
                    std::move(*simulation),
                    seconds_per_cycle,
                    std::move(scheduled),
                    std::move(until),
                    std::move(clamped),
                    std::move(manipulated),
                    std::move(run_measures),
                    std::move(measures),
                    std::move(plots),
                    std::nullopt,
                    {},
                    {},
                    nullptr};
        if (!o.directory.empty()) {
            try {
                make_directory(o.directory);
            } catch (const std::exception& e) {
                diagnostics.error({}, e.what(), "choose another directory for the results with -o");
                return std::nullopt;
            }
            try {
                out.hold = DirectoryHold(o.directory);
            } catch (const std::exception& e) {
                diagnostics.error({}, e.what(), held_hint);
                return std::nullopt;
            }
            out.recordings.emplace(std::move(files), o.record, o.directory, run_attributes(o, out.loaded));
        }
        if (o.paths && !o.directory.empty() && out.loaded.world)
            for (std::size_t i = 0; i < out.loaded.world->bugs(); ++i)
                out.paths.emplace_back(*out.loaded.world, i);
        if (!o.video.empty() && out.loaded.world) {
            constexpr double frame = 0.1;  // s of the world, about
            out.film_every =
                std::max<std::uint64_t>(1, static_cast<std::uint64_t>(frame / seconds_per_cycle + 0.5));
            out.film = std::make_unique<plot::Film>(*out.loaded.world, o.video,
                                                    static_cast<double>(out.film_every) * seconds_per_cycle,
                                                    picture_title(o, out.loaded));
        }
        return out;
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        return std::nullopt;
    }
}

std::vector<std::string> write_tables(const RunOptions& o, Running& r, Outcome& outcome) {
    std::vector<std::string> problems;
    if (r.recordings) {
        if (const std::string problem = r.recordings->finish(); !problem.empty()) problems.push_back(problem);
        for (auto& name : r.recordings->files()) outcome.files.push_back(std::move(name));
        outcome.recordings = r.recordings->entries();
    }
    if (!r.loaded.world) return problems;
    for (std::size_t i = 0; i < outcome.trials.size(); ++i) try {
            const std::string name = "trials" + robot_suffix(*r.loaded.world, i) + ".csv";
            write_file(o.directory + "/" + name, trials_csv(outcome.trials[i]));
            outcome.files.push_back(name);
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }
    if (!r.loaded.world->game().empty()) try {
            write_file(o.directory + "/score.csv", score_csv(r.loaded.world->game()));
            outcome.files.emplace_back("score.csv");
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }
    return problems;
}

std::string robot_suffix(const bug::World& world, std::size_t robot) {
    return world.bugs() > 1 ? "_" + file_name(world.robot_names()[robot]) : "";
}

void note(const Running& running, Outcome& outcome) {
    outcome.cycles = running.simulation.cycle();
    outcome.seconds = running.seconds();
    outcome.diverged = running.diverged;
    outcome.shared_cycles = running.simulation.shared_cycles();
    const auto& groups = running.simulation.layout().groups;
    outcome.groups = static_cast<int>(groups.size());
    for (int g = 0; g < outcome.groups; ++g)
        if (running.simulation.pruned(g)) outcome.pruned.push_back(groups[g].path);
    for (const auto& e : running.schedule.entries()) outcome.changes.push_back({e.text, e.cycle});
    for (std::size_t i = 0; i < running.measures.size(); ++i)
        outcome.trials.push_back(
            trials_of(*running.loaded.world, i, running.measures[i], running.simulation));
}

}  // namespace forage::tool
