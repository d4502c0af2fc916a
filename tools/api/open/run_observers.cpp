#include "tools/api/open/run_observers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <forage/forage.h>

#include "core/observe/manipulation_spec.h"
#include "core/run/broadcaster.h"
#include "core/run/path_recorder.h"
#include "core/run/recordings.h"
#include "core/run/result_names.h"
#include "core/run/run_json.h"
#include "tools/api/open/motor_statistics.h"
#include "tools/api/open/moves.h"
#include "tools/plot/plots.h"

namespace forage {
namespace {

/// Writes score.csv at the end of a run in which a game is played.
class ScoreRecorder final : public Observer {
  public:
    std::vector<std::string> file_names() const override { return {"score.csv"}; }
    void finish(RunView& run, ResultFiles& files) override {
        files.write("score.csv", [&] { return run.environment->score_csv(); });
    }
};

/// What the functions of the table work on.
struct Preparation {
    PreparedRun& prepared;
    bug::World* world;  ///< null without robots
    Diagnostics& diagnostics;
    plot::Format format;                         ///< of pictures
    std::vector<plot::PlotSpec> trajectories{};  ///< plots of paths, which need their recorders

    const RunSpec& spec() const { return prepared.spec; }
    Run& run() { return prepared.run; }
    /// Calls a function with the index of each robot, and the end of the names of files about it: "_NAME", or
    /// nothing when there is only one robot.
    template <class Function>
    void for_each_robot(const Function& function) const {
        if (!world) return;
        const auto names = world->robot_names();
        for (std::size_t i = 0; i < names.size(); ++i)
            function(i, names.size() > 1 ? "_" + file_name(names[i]) : "");
    }
};

void add_schedule(Preparation& p) {
    p.prepared.schedule = &p.run().add(
        observe::make_schedule(p.spec().changes, p.run().system(), p.run().registry(), p.run().layout(),
                               p.run().has_trials(), p.diagnostics, actions_on(p.run())));
}

void add_measures(Preparation& p) {
    p.prepared.measures = &p.run().add(std::make_unique<RunMeasures>(p.spec().measures, p.run().layout(),
                                                                     p.run().environment(), p.diagnostics));
}

void add_manipulations(Preparation& p) {
    observe::KnownLength length{p.run().seconds_per_cycle()};
    if (const auto cycles = p.prepared.stop.cycles()) length.cycles = static_cast<double>(*cycles);
    if (const auto& trials = p.spec().length.trials) length.trials = static_cast<double>(*trials);
    for (auto& m : observe::make_manipulations(p.spec().manipulations, p.run().layout(), p.run().has_trials(),
                                               p.diagnostics, length))
        p.run().add(std::move(m));
}

void add_statistics(Preparation& p) {
    if (!p.spec().explain) return;
    p.prepared.statistics = &p.run().add(std::make_unique<observe::GroupStatistics>(p.run().layout()));
    if (p.world)
        p.prepared.motor_report = [motors = &p.run().add(std::make_unique<MotorStatistics>(
                                       p.run(), *p.world))] { return motors->sentences(); };
}

void add_plots(Preparation& p) {
    p.trajectories = plot::add_plots(p.spec().plots, p.run(), p.format, p.run().title, p.diagnostics);
}

void add_trials(Preparation& p) {
    p.for_each_robot([&](std::size_t robot, const std::string& suffix) {
        p.run().add(std::make_unique<TrialRecorder>(*p.world, robot, p.run().layout(), trials_file(suffix)));
    });
}

void add_scores(Preparation& p) {
    if (p.world && !p.world->scores().empty()) p.run().add(std::make_unique<ScoreRecorder>());
}

void add_paths(Preparation& p) {
    if (!p.spec().paths || p.spec().directory.empty()) return;
    p.for_each_robot([&](std::size_t robot, const std::string& suffix) {
        const auto& path =
            p.run().add(std::make_unique<PathRecorder>(*p.world, robot, trajectory_file(suffix)));
        const auto draw = [&](std::optional<plot::PlotSpec> wanted) {
            p.run().add(std::make_unique<plot::TrajectoryPlotter>(
                *p.world, path, std::move(wanted), "trajectory" + suffix, p.format, p.run().title));
        };
        for (const auto& wanted : p.trajectories) draw(wanted);
        if (p.trajectories.empty()) draw({});
    });
}

void add_film(Preparation& p) {
    const auto& spec = p.spec();
    if (spec.video.empty()) return;
    if (auto film = plot::make_film(p.run(), spec.video, spec.video_groups, "--video", "--video-group",
                                    p.diagnostics))
        p.run().add(std::move(film));
}

void add_broadcaster(Preparation& p) {
    const auto& spec = p.spec().broadcast;
    const auto& layout = p.run().layout();
    std::vector<observe::Source> sources;
    const auto add = [&](const std::string& text, const Location& at) {
        auto source = observe::find_source(layout, text, "--broadcast-group", p.diagnostics, at);
        if (source && source->what().synapses)
            p.diagnostics.error(at, fmt::format("--broadcast-group '{}' is a connection", text),
                                "name a group");
        else if (source)
            sources.push_back(std::move(*source));
    };
    for (const auto& source : spec.sources) add(source.text, source.at);
    if (!spec.to || p.diagnostics.failed()) return;
    if (spec.sources.empty())
        for (const auto& g : layout.groups) add("#" + g.id, {});
    p.run().add(std::make_unique<Broadcaster>(*spec.to, std::move(sources),
                                              std::chrono::milliseconds(spec.interval_ms)));
}

void add_remote(Preparation& p) {
    if (!p.spec().remote || p.diagnostics.failed()) return;
    auto& remote = p.run().add(std::make_unique<RemoteControl>(*p.spec().remote));
    p.prepared.remote = &remote;
    if (p.spec().directory.empty()) return;
    remote.plot = [directory = p.spec().directory, format = p.format](const RemoteCommand& command,
                                                                      const std::string& id, Run& now) {
        plot::PlotSpec spec;
        std::string what = id;
        if (command.item == RemoteCommand::Item::group) {
            if (now.cycle() == 0) throw InputError("there is no cycle to draw yet");
            const std::string state = command.parameter.empty() ? "" : ":" + command.parameter;
            Diagnostics diagnostics;
            const auto source = checked(
                diagnostics, observe::find_source(now.layout(), "#" + id + state, "plot", diagnostics));
            what = "\"#" + id + "\"" + state;
            spec.kind = plot::PlotSpec::Kind::space, spec.what = source->what().name;
            spec.cycles_text = std::to_string(now.cycle() - 1);
        } else {
            spec.kind = plot::PlotSpec::Kind::connection, spec.what = id;
            spec.cycles_text = std::to_string(now.cycle());
        }
        const std::string name = spec.file(format);
        write_result(directory + "/" + name, draw(now, fmt::format("{}:{}", spec.name(spec.kind), what),
                                                  std::string(plot::ending(format).substr(1))));
        return name;
    };
}

void add_recordings(Preparation& p) {
    const auto& spec = p.spec();
    auto files = recorded_files(spec.recordings, spec.record, p.run().layout(), p.diagnostics);
    if (spec.directory.empty()) return;
    p.run().add(std::make_unique<Recordings>(
        std::move(files), spec.record, spec.directory,
        run_attributes(spec, p.run(), p.prepared.plugins, p.prepared.libraries)));
}

/// Observers are called, and written to checkpoints, in this order. Recordings are the last: when a
/// checkpoint does not fit the run, it is refused before a file of a recording changes.
constexpr void (*add_in_order[])(Preparation&) = {
    add_schedule, add_measures, add_manipulations, add_statistics,  add_plots,  add_trials,
    add_scores,   add_paths,    add_film,          add_broadcaster, add_remote, add_recordings,
};

}  // namespace

void add_observers(PreparedRun& prepared, bug::World* world, Diagnostics& diagnostics) {
    prepared.run.title = run_title(prepared.spec.input);
    Preparation preparation{prepared, world, diagnostics, *plot::format_of("x." + prepared.spec.plot_format)};
    for (const auto add : add_in_order) add(preparation);
}

void add_checkpoints(PreparedRun& prepared, const Sources& sources) {
    const RunSpec& spec = prepared.spec;
    if (!spec.checkpoint_every) return;
    Run& run = prepared.run;
    const auto& [amount, in_seconds] = *spec.checkpoint_every;
    const double cycles = in_seconds ? amount / run.seconds_per_cycle() : amount;
    CheckpointOrigin origin{FORAGE_VERSION,
                            spec.arguments,
                            std::filesystem::current_path().string(),
                            input_files(spec, sources),
                            {},
                            0};
    prepared.checkpoints = &run.add(std::make_unique<CheckpointWriter>(
        spec.directory, static_cast<std::uint64_t>(std::max(1.0, std::round(std::min(cycles, 1e15)))),
        std::move(origin), module_files(run.system(), run.registry(), prepared.schedule->assignments())));
}

}  // namespace forage
