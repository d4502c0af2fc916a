#include "tools/api/prepare.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/versions.h"
#include "core/base/cores.h"
#include "core/base/separated.h"
#include "core/observe/manipulation_spec.h"
#include "core/run/broadcaster.h"
#include "core/run/checkpoint_file.h"
#include "core/run/path_recorder.h"
#include "core/run/recordings.h"
#include "core/run/run_json.h"
#include "core/run/score_recorder.h"
#include "tools/api/motor_statistics.h"
#include "tools/api/tables.h"
#include "tools/api/world_actions.h"
#include "tools/plot/plots.h"

namespace forage {
namespace {

constexpr double default_seconds = 60;  ///< length of a run, s of the world

/// The suffix "_name" of files about a robot; empty when there is only one robot.
std::string robot_suffix(const Environment& environment, std::size_t robot) {
    const auto names = environment.robot_names();
    return names.size() > 1 ? "_" + file_name(names[robot]) : "";
}

/// Creates and locks the directory for results.
bool open_directory(const std::string& directory, DirectoryHold& hold, Diagnostics& diagnostics) {
    const char* hint = "choose another directory for the results with -o";
    try {
        make_directory(directory);
        hint = held_hint;
        hold = DirectoryHold(directory);
        return true;
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what(), hint);
        return false;
    }
}

void check_video(const RunSpec& spec, Diagnostics& diagnostics) {
    if (spec.video.empty()) return;
    if (plot::Film::is_name(spec.video))
        check_output(spec.video, "film.gif", diagnostics);
    else
        diagnostics.error({}, fmt::format("--video: '{}' is not the name of a film", spec.video),
                          "it ends with .gif or .png");
}

void add_world_observers(Run& run, bug::World& world, const RunSpec& spec,
                         const std::vector<plot::PlotSpec>& trajectories, plot::Format format,
                         const std::string& title) {
    for (std::size_t i = 0; i < world.robot_names().size(); ++i)
        run.add(std::make_unique<TrialRecorder>(world, i, run.layout(),
                                                "trials" + robot_suffix(world, i) + ".csv"));
    if (!world.scores().empty()) run.add(std::make_unique<ScoreRecorder>());
    if (spec.paths && !spec.directory.empty())
        for (std::size_t i = 0; i < world.robot_names().size(); ++i) {
            const std::string name = "trajectory" + robot_suffix(world, i);
            const auto& path = run.add(std::make_unique<PathRecorder>(world, i, name + ".csv"));
            const auto draw = [&](std::optional<plot::PlotSpec> wanted) {
                run.add(std::make_unique<plot::TrajectoryPlotter>(world, path, std::move(wanted), name,
                                                                  format, title));
            };
            for (const auto& wanted : trajectories) draw(wanted);
            if (trajectories.empty()) draw({});
        }
    if (!spec.video.empty())
        run.add(std::make_unique<plot::FilmRecorder>(world, spec.video, run.seconds_per_cycle(), title));
}

/// The groups whose averages are sent.
std::vector<observe::Source> broadcast_sources(const BroadcastSpec& spec, const engine::Layout& layout,
                                               Diagnostics& diagnostics) {
    std::vector<observe::Source> out;
    const auto add = [&](const std::string& text, const Location& at) {
        auto source = observe::find_source(layout, text, "--broadcast-group", diagnostics, at);
        if (source && source->what().synapses)
            diagnostics.error(at, fmt::format("--broadcast-group '{}' is a connection", text),
                              "name a group");
        else if (source)
            out.push_back(std::move(*source));
    };
    for (const auto& [text, at] : spec.sources) add(text, at);
    if (spec.to && spec.sources.empty())
        for (const auto& g : layout.groups) add("#" + g.id, {});
    return out;
}

RemoteControl& add_remote(Run& run, const RunSpec& spec, plot::Format format, const std::string& title) {
    auto& remote = run.add(std::make_unique<RemoteControl>(*spec.remote));
    if (!spec.directory.empty())
        remote.plot = [=, directory = spec.directory](const RemoteCommand& command, const std::string& id,
                                                      Run& now) {
            const auto drawn = command.item == RemoteCommand::Item::group
                                   ? plot::draw_group_now(now, id, command.parameter, format, title)
                                   : plot::draw_connection_now(now, id, format, title);
            write_file(directory + "/" + drawn.name, drawn.content);
            return drawn.name;
        };
    return remote;
}

CheckpointWriter& add_checkpoints(Run& run, const RunSpec& spec, const Sources& sources,
                                  const observe::Schedule& schedule) {
    const auto& wanted = *spec.checkpoint_every;
    const double cycles = wanted.in_seconds ? wanted.amount / run.seconds_per_cycle() : wanted.amount;
    CheckpointOrigin origin{FORAGE_VERSION,
                            spec.arguments,
                            std::filesystem::current_path().string(),
                            input_files(spec, sources),
                            {},
                            0};
    return run.add(std::make_unique<CheckpointWriter>(
        spec.directory, static_cast<std::uint64_t>(std::max(1.0, std::round(std::min(cycles, 1e15)))),
        std::move(origin), module_files(run.system(), run.registry(), schedule.assignments())));
}

}  // namespace

std::optional<PreparedRun> prepare(const Sources& sources, const RunSpec& given, Diagnostics& diagnostics) {
    RunSpec spec = given;
    auto& length = spec.length;
    if (!length.cycles && !length.trials && !length.seconds) length.seconds = default_seconds;
    auto loaded = assemble(sources, spec.input, diagnostics);
    if (!loaded) return std::nullopt;
    check_video(spec, diagnostics);
    if (sources.replay) check_replay(*sources.replay, loaded->system, diagnostics);
    bug::World* world = loaded->world.get();
    auto made = Run::make(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                          {.seed = spec.input.seed,
                           .threads = std::min(spec.threads, cores()),
                           .compute_everything = false,
                           .check_finite = spec.on_nan != OnNan::ignore,
                           .directory = spec.directory},
                          diagnostics);
    if (!made) return std::nullopt;
    Run& run = *made;
    StopCondition stop = StopCondition::make(length, run, diagnostics);
    auto schedule = observe::make_schedule(spec.changes, run.system(), run.registry(), run.layout(),
                                           run.has_trials(), diagnostics, actions_on(run));
    auto measures =
        std::make_unique<RunMeasures>(spec.measures, run.layout(), run.environment(), diagnostics);
    auto manipulations =
        observe::make_manipulations(spec.manipulations, run.layout(), run.has_trials(), diagnostics);
    auto sent = broadcast_sources(spec.broadcast, run.layout(), diagnostics);
    auto recorded = recorded_files(spec.recordings, spec.record, run.layout(), diagnostics);

    const auto* schedule_added = &run.add(std::move(schedule));
    auto* measures_added = &run.add(std::move(measures));
    stop.declare(run.demand());
    for (auto& m : manipulations) run.add(std::move(m));
    const observe::GroupStatistics* statistics =
        spec.explain ? &run.add(std::make_unique<observe::GroupStatistics>(run.layout())) : nullptr;
    std::function<std::vector<std::string>()> commands = [] { return std::vector<std::string>(); };
    if (spec.explain && world)
        commands = [motors = &run.add(std::make_unique<MotorStatistics>(run, *world))] {
            return motors->sentences();
        };
    const plot::Format format = *plot::format_of("x." + spec.plot_format);
    const std::string title = run_title(spec.input);
    const auto trajectories = plot::add_plots(spec.plots, run, format, title, diagnostics);
    if (spec.checkpoint_every && spec.directory.empty())
        diagnostics.error({}, "--checkpoint-every needs a directory to write to",
                          "leave out -o '' or name one");
    if (spec.checkpoint_every || spec.digest)
        check_checkpoints(run.layout(), spec.checkpoint_every ? "--checkpoint-every" : "--hash", diagnostics);
    if (spec.digest) run.demand().read_everything();
    if (diagnostics.failed()) {
        run.start(diagnostics);  // reports further mistakes
        return std::nullopt;
    }
    try {
        const std::vector<std::pair<std::string, std::string>> libraries = bug::library_versions();
        DirectoryHold hold;
        if (world) add_world_observers(run, *world, spec, trajectories, format, title);
        if (spec.broadcast.to)
            run.add(std::make_unique<Broadcaster>(*spec.broadcast.to, std::move(sent),
                                                  std::chrono::milliseconds(spec.broadcast.interval_ms)));
        RemoteControl* remote = spec.remote ? &add_remote(run, spec, format, title) : nullptr;
        // The state of recordings is read last from a checkpoint, so that no file is changed when something
        // else does not fit.
        if (!spec.directory.empty())
            run.add(std::make_unique<Recordings>(std::move(recorded), spec.record, spec.directory,
                                                 run_attributes(spec, run, loaded->plugins, libraries)));
        if (!run.start(diagnostics)) return std::nullopt;
        if (!spec.directory.empty() && !open_directory(spec.directory, hold, diagnostics))
            return std::nullopt;
        CheckpointWriter* checkpoints = nullptr;
        if (spec.checkpoint_every) checkpoints = &add_checkpoints(run, spec, sources, *schedule_added);
        return PreparedRun{std::move(spec),
                           std::move(hold),
                           std::move(run),
                           std::move(stop),
                           schedule_added,
                           measures_added,
                           checkpoints,
                           remote,
                           statistics,
                           std::move(commands),
                           std::move(loaded->plugins),
                           libraries};
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        return std::nullopt;
    }
}

void clear_directory(const RunSpec& spec, Diagnostics& diagnostics) {
    const std::string& directory = spec.directory;
    if (has_checkpoint(directory) && !spec.discard_checkpoint)
        return diagnostics.error(
            {}, fmt::format("'{}' holds the checkpoint of a run that has not finished", directory),
            fmt::format("'forage resume {}' continues that run; --discard-checkpoint gives it up, and -o "
                        "names another "
                        "directory",
                        directory));
    remove_checkpoints(directory);
    const auto removed = remove_unfinished(directory);
    if (!removed.empty())
        diagnostics.warning(
            {}, fmt::format("removed from '{}', as a run was killed before it finished them: {}", directory,
                            separated(removed, ", ")));
}

void begin(PreparedRun& p) {
    if (p.spec.directory.empty()) return;
    ResultFiles files(p.spec.directory);
    check_regular_file(files.path("run.json"));
    for (const auto& o : p.run.observers())
        for (const auto& name : o->file_names()) check_regular_file(files.path(name));
    for (const auto& o : p.run.observers()) o->begin_files(files);
}

}  // namespace forage
