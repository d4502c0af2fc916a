// The options of `forage run` and `forage explain`.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/model/expression.h"
#include "core/model/lookup.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

/// "500" cycles or "10 s" of the world.
CheckpointInterval parse_interval(const std::string& text) {
    std::string_view number = model::trim(text);
    CheckpointInterval out;
    out.in_seconds = number.ends_with("s");
    if (out.in_seconds) number = model::trim(number.substr(0, number.size() - 1));
    out.amount = parse_number<double>(number).value_or(0);
    if (!(out.amount > 0) || (!out.in_seconds && out.amount != std::floor(out.amount)))
        throw CLI::ValidationError(
            "--checkpoint-every",
            fmt::format("'{}' is neither a number of cycles nor of seconds, such as '1000' or '60 s'", text));
    return out;
}

/// The result of `parse` for the text of an option.
template <class Parse>
auto parsed(const char* option, const std::string& text, Parse parse) {
    try {
        return parse();
    } catch (const expression::Mistake& m) {
        throw CLI::ValidationError(option, m.described(text));
    }
}

void add_manipulations(CLI::App& run, RunSpec& o) {
    using Mode = model::ManipulationSpec::Mode;
    const auto add = [&](const char* option, Mode mode, const char* description) {
        const auto take = [&o, option, mode](const std::string& text) {
            model::ManipulationSpec spec;
            spec.mode = mode, spec.table = {text}, spec.text = text;
            std::error_code none;
            if (!exists(std::filesystem::symlink_status(text, none)))  // may have '='
                spec = parsed(option, text, [&] { return expression::parse_manipulation(mode, text); });
            o.manipulations.push_back(std::move(spec));
        };
        add_each(run, option, take, "MANIPULATION", description);
    };
    add("--clamp", Mode::clamp,
        "Overwrite the activity of a group: 'Process/Group(x,y)=value' sets a cell, and all others to 0; "
        "'Process/Group=FILE' applies a list of patterns; FILE is a table of rows "
        "cycle,process,group,v0,v1,...; options follow ';', such as '; every 10; until trial 5'. See "
        "docs/reference/expressions.md; may be repeated");
    add("--add", Mode::add, "Add to the activity of a group, after any --clamp; written as for --clamp");
    add("--multiply", Mode::multiply,
        "Multiply the activity of a group, after any --add; written as for --clamp");
}

void add_recording(CLI::App& run, RunSpec& o) {
    auto* record = add_each(
        run, "-r,--record", [&o](const std::string& text) { o.recordings.push_back({{text}}); }, "SOURCE",
        "Write 'Process/Group' (its activity) or 'Process/Group:state' to a file; '...(x1..x2,y1..y2)' for "
        "some of its cells, 'mean(...)' for their mean, '...=NAME.h5' to name the file; may be repeated");
    add_value(run, "--format", o.record.format, "FORMAT",
              "Format of recordings without a file name: csv, npy, npz (NumPy), h5 (HDF5) or dat (the "
              "original's data sampler) [csv]")
        ->check(one_of({"csv", "npy", "npz", "h5", "dat"}))
        ->needs(record);
    run.add_option_function<std::uint64_t>(
           "--record-every",
           [&o](const std::uint64_t& every) {
               for (auto& r : o.recordings) r.every = every;
           },
           "Record every K-th cycle [1]")
        ->transform(count())
        ->option_text("K")
        ->needs(record);
    run.add_flag("--record-mean", o.record.mean, "Record the mean of K cycles instead of every K-th")
        ->needs("--record-every");
    add_value(run, "--record-from", o.record.from, "CYCLE", "Record from this cycle on [0]")
        ->transform(seed())
        ->needs(record);
    add_value(run, "--record-until", o.record.until, "CYCLE", "Record up to this cycle")
        ->transform(seed())
        ->needs(record);
    add_texts(run, "-p,--plot", o.plots,
              "Draw a picture: 'time:SOURCE', 'space:SOURCE@CYCLES', 'movie:SOURCE', 'connection:NAME' or "
              "'diagram', see 'forage plot --help'; may be repeated",
              "PLOT");
    add_plot_format(run, o.plot_format);
}

/// Reads HOST:PORT or PORT.
Endpoint endpoint(const std::string& option, const std::string& text, int lowest) {
    const auto out = parse_endpoint(text);
    if (!out || out->port < lowest)
        throw CLI::ValidationError(
            option,
            fmt::format(
                "'{}' is neither a port, such as '54923', nor a host and a port, such as '127.0.0.1:54923'",
                text));
    return *out;
}

void add_network(CLI::App& run, RunSpec& o) {
    run.add_option_function<std::string>(
           "--remote", [&o](const std::string& text) { o.remote = endpoint("--remote", text, 0); },
           "Obey commands that arrive as datagrams at this port of this computer: 'cmd:stop', "
           "'cmd:param;...'. 0 takes a free port; HOST:PORT listens at another address, to every machine "
           "that reaches it")
        ->option_text("PORT");
    auto* broadcast =
        run.add_option_function<std::string>(
               "--broadcast",
               [&o](const std::string& text) { o.broadcast.to = endpoint("--broadcast", text, 1); },
               "Send the average activity of all groups in datagrams, 'groupID:average;...'")
            ->option_text("HOST:PORT");
    add_value(run, "--broadcast-every", o.broadcast.interval_ms, "MS",
              "Milliseconds of the clock between datagrams [500]")
        ->check(CLI::Range(40, 10000))
        ->needs(broadcast);
    add_texts(run, "--broadcast-group", o.broadcast.sources,
              "Send the average of this group, as for --record, instead of all; may be repeated", "SOURCE")
        ->needs(broadcast);
}

/// The words of a command line that decide its results.
std::vector<std::string> deciding_words(const CLI::App& run) {
    static constexpr std::string_view others[] = {
        "output",          "threads",        "checkpoint-every", "discard-checkpoint",
        "quiet",           "realtime",       "bundle",           "video",
        "video-group",     "remote",         "broadcast",        "help",
        "broadcast-every", "broadcast-group"};
    std::vector<std::string> out = {run.get_name()};
    for (const auto* option : run.get_options()) {
        const bool positional = option->get_positional();
        const std::string name = positional ? "" : option->get_lnames().front();
        if (option->empty() || std::ranges::find(others, name) != std::end(others)) continue;
        if (option->get_expected_max() == 0) {
            out.push_back("--" + name);
            continue;
        }
        for (const auto& value : option->results()) {
            if (!positional) out.push_back("--" + name);
            out.push_back(value);
        }
    }
    return out;
}

/// Adds the options of `forage run`.
void add_run_options(CLI::App& run, RunOptions& options) {
    RunSpec& o = options.spec;
    add_input(run, o.input);
    auto* cycles =
        add_value(run, "-c,--cycles", o.length.cycles, "N", "Stop after N cycles")->transform(count());
    auto* seconds = add_value(run, "--seconds", o.length.seconds, "S", "Stop after S seconds of the world")
                        ->check(positive());
    auto* trials = add_value(run, "-t,--trials", o.length.trials, "N",
                             "Stop after N trials; a trial ends when the robot is reset")
                       ->transform(count());
    cycles->excludes(seconds)->excludes(trials);
    seconds->excludes(trials);
    add_value(run, "--trial-timeout", o.length.trial_timeout, "S",
              "Stop when a trial takes longer than S seconds of the world [300]")
        ->check(positive())
        ->needs(trials);
    add_value(run, "--seed", o.input.seed, "N", "Decides everything random [1]")->transform(seed());
    add_recording(run, o);
    add_value(run, "--until", o.length.until.text, "WHEN",
              "Stop early when a condition holds, as for --schedule");
    const auto schedule = [&o](const std::string& text) {
        o.changes.push_back(parsed("--schedule", text, [&] { return expression::parse_change(text); }));
    };
    add_each(
        run, "--schedule", schedule, "'WHEN: WHERE=VALUE'",
        "Change a parameter when a condition first holds: 'cycle N', 'trial N', 'N s', or comparisons of "
        "cycle, trial, seconds, cells 'Process/Group(x,y)' and mean(Process/Group), joined by 'and' and "
        "'or'. Instead of WHERE=VALUE, 'move NAME=X,Y' moves a robot or an object (m), and 'begin_trial' "
        "ends a trial. See docs/reference/expressions.md; may be repeated");
    add_value(run, "--replay", o.input.replay, "FILE",
              "Table that modules of type moduleReplay play: cycle,process,target,v0,v1,...");
    add_manipulations(run, o);
    add_network(run, o);
    add_value(run, "-o,--output", o.directory, "DIR", "Directory for results [forage-out]; '' for none");
    add_value(run, "--real-time-factor", o.input.real_time_factor, "X",
              "Seconds of the world per second of the clock, instead of the world's own")
        ->check(positive())
        ->needs("--world");
    run.add_flag_callback(
        "--no-noise", [&o] { o.input.noise = false; },
        "Motors and sensors have no noise; start positions still vary");
    run.add_flag("--sensor-rates", o.input.sensor_rates,
                 "Sensors have the rates of the world file, instead of once per cycle")
        ->needs("--world");
    add_value(run, "--latency", o.input.latency, "CYCLES",
              "Number of cycles by which sensor values arrive later [0]")
        ->check(CLI::Range(0, 1000))
        ->needs("--world");
    run.add_flag("--game", o.input.game,
                 "Play the robotics challenge: two teams collect resources for five minutes")
        ->needs("--world");
    add_value(run, "--video", o.video, "FILE",
              "Film the world from above, with what the robots see: an animated .gif, an .mp4 film (needs "
              "ffmpeg), or numbered .png files")
        ->needs("--world");
    add_texts(
        run, "--video-group", o.video_groups,
        "Show a source, such as 'Process/Group' or 'Process/Group:vm', beside the world of the film; may be "
        "repeated",
        "SOURCE")
        ->needs("--video");
    add_value(run, "--threads", o.threads, "N",
              "Largest number of threads that share a cycle. It pays for large systems, while cores are "
              "idle. The numbers do not depend on it [1]")
        ->transform(threads());
    run.add_option_function<std::string>(
           "--checkpoint-every", [&o](const std::string& text) { o.checkpoint_every = parse_interval(text); },
           "Write a checkpoint every N cycles, or every 'N s' of the world. After any stop, even a power "
           "cut, 'forage resume' continues from there")
        ->option_text("N")
        ->excludes("--video");  // a film cannot be resumed
    add_value(run, "--bundle", o.bundle, "FILE",
              "Write everything that repeats the run, and its results, to one .zip file for 'forage "
              "rerun' and for archives")
        ->check(named("file"))
        ->excludes("--remote");  // what a network sends is not repeated
    run.add_flag("--discard-checkpoint", o.discard_checkpoint,
                 "Discard an unfinished run: without it, a directory with a checkpoint is refused");
    run.add_option_function<std::string>(
           "--on-nan",
           [&o](const std::string& text) {
               o.on_nan = text == "warn" ? OnNan::warn : text == "stop" ? OnNan::stop : OnNan::ignore;
           },
           "When a number becomes NaN or infinite in a group that is computed: 'warn' once and continue, "
           "'stop', or 'ignore' it [warn]")
        ->check(one_of({"warn", "stop", "ignore"}))
        ->option_text("HOW");
    run.add_flag(
        "--hash", o.digest,
        "Print a digest of the final state: equal runs have equal digests. All groups are computed for it");
    run.add_flag("--realtime", options.real_time,
                 "Run at most as fast as the clock: one second of the world per second");
    run.add_flag("-q,--quiet", options.quiet, "Print errors only");
    run.callback([&run, &o] { o.command = deciding_words(run); });
}

void declare_run(CLI::App& run, RunOptions& options) {
    run.footer(
        "Without --cycles, --seconds or --trials it runs for 60 seconds of the world.\n"
        "Example:\n"
        "  forage run systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world --trials 30\n"
        "  ... --schedule 'trial 10: Motor In to Motor.weight=0.5' --schedule 'max(Bug/Light) > 0.9: "
        "Bug/Light.threshold=1'");
    add_run_options(run, options);
}

}  // namespace

void add_run(Program& program) {
    auto& options = program.options<RunOptions>();
    declare_run(program.add("run", "Run a system, in a world if one is given",
                            [&] {
                                for (char** word = program.arguments() + 1; *word; ++word)
                                    options.spec.arguments.emplace_back(*word);
                                return run(options);
                            }),
                options);
}

void add_explain(Program& program) {
    const auto [explain, options] = program.add(
        "explain", "Run a system, and tell what its groups did and why some were silent", run,
        "Prints the mean, least and largest activity and inputs of every group, which groups nothing "
        "drives,\n"
        "which thresholds were never reached, and the way back from a silent motor to the first silent "
        "group.\n"
        "Example:\n"
        "  forage explain systems/reactive_foraging_exercise.iqr --world systems/worlds/basic_arena.world");
    options.spec.explain = true;
    options.spec.directory.clear();
    add_run_options(explain, options);
    for (const char* name : {"--checkpoint-every", "--discard-checkpoint", "--remote",
                             "--bundle"})  // a resumed run explains nothing
        explain.remove_option(explain.get_option(name));
}

RunOptions parse_run(std::vector<std::string> arguments) {
    CLI::App app;
    RunOptions options;
    declare_run(*app.add_subcommand("run"), options);
    arguments = current_names(std::move(arguments));
    std::ranges::reverse(arguments);  // as CLI11 takes them
    app.parse(arguments);
    return options;
}

}  // namespace forage::tool
