// forage: run and check iqr systems from the command line.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/model/diagnostic.h"
#include "core/model/lookup.h"
#include "core/types/parameter.h"
#include "tools/forage/commands.h"
#include "tools/forage/manipulations.h"
#include "tools/forage/reference.h"
#include "tools/forage/schedule.h"

namespace {

using namespace forage::tool;
namespace model = forage::model;

/// A number that `fits`, in words that a person reads.
CLI::Validator number_that(bool (*fits)(double), const char* description) {
    return CLI::Validator(
        [=](std::string& text) {
            const auto value = forage::parse_parameter(forage::ParameterKind::real, text);
            return value && fits(std::get<double>(*value)) ? std::string()
                                                           : fmt::format("'{}' is not {}", text, description);
        },
        "");
}
CLI::Validator positive() {
    return number_that([](double v) { return v > 0 && v <= 1e9; }, "a number above 0, at most 1e9");
}
CLI::Validator count() {
    return number_that([](double v) { return v >= 1 && v <= 1e15 && v == std::floor(v); },
                       "a whole number, at least 1");
}
CLI::Validator seed() {
    return number_that([](double v) { return v >= 0 && v < 1.8e19 && v == std::floor(v); },
                       "a whole number, at least 0");
}

/// "500" cycles or "10 s" of the world.
CheckpointInterval parse_interval(const std::string& text) {
    std::string_view number = model::trim(text);
    CheckpointInterval out;
    out.in_seconds = number.ends_with("s");
    if (out.in_seconds) number = model::trim(number.substr(0, number.size() - 1));
    const auto value = forage::parse_parameter(forage::ParameterKind::real, number);
    if (value) out.amount = std::get<double>(*value);
    if (!(out.amount > 0) || (!out.in_seconds && out.amount != std::floor(out.amount)))
        throw CLI::ValidationError(
            "--checkpoint-every",
            fmt::format("'{}' is neither a number of cycles nor of seconds, such as '1000' or '60 s'", text));
    return out;
}

CLI::Option* repeated(CLI::Option* option) {
    return option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_plugins(CLI::App& command, std::vector<std::string>& plugins) {
    repeated(command.add_option("--plugin", plugins,
                                "Plugin with more types (.so), or a folder of plugins, besides those in "
                                "FORAGE_PLUGIN_PATH and in the folder plugins beside the system; may be "
                                "repeated"))
        ->option_text("PATH");
}

void add_input(CLI::App& command, Input& input) {
    command
        .add_option_function<std::vector<std::string>>(
            "SYSTEM",
            [&input](const std::vector<std::string>& files) {
                input.system = files.front();
                input.more.assign(files.begin() + 1, files.end());
            },
            "System file (.iqr), or a process on its own (.iqrProcess); several run together, in lock-step")
        ->required()
        ->expected(1, 1000)
        ->option_text("FILE...");
    command.add_option("-w,--world", input.world, "World in which the robot lives (.world)")
        ->option_text("FILE");
    repeated(
        command.add_option_function<std::vector<std::string>>(
            "-s,--set",
            [&input](const std::vector<std::string>& texts) {
                for (const auto& text : texts) input.settings.push_back({text});
            },
            "Change a parameter: 'Process/Group.parameter=value', 'Process.parameter=value' for a module, "
            "'Connection.parameter=value' for a synapse; may be repeated"))
        ->option_text("WHERE=VALUE");
    add_plugins(command, input.plugins);
    command.add_flag("--lenient", input.lenient,
                     "Unknown parameters and attributes are warnings, not errors");
}

void add_manipulations(CLI::App& run, RunOptions& o) {
    using Mode = model::ManipulationWish::Mode;
    const auto add = [&](const char* option, Mode mode, const char* description, const char* text) {
        repeated(run.add_option_function<std::vector<std::string>>(
                     option,
                     [&o, option, mode](const std::vector<std::string>& texts) {
                         for (const auto& each : texts) {
                             const bool table =
                                 each.find('=') == std::string::npos || std::filesystem::exists(each);
                             if (mode == Mode::clamp && table) {
                                 o.clamp.push_back(each);
                                 continue;
                             }
                             try {
                                 o.manipulations.push_back(parse_manipulation(mode, each));
                             } catch (const std::invalid_argument& e) {
                                 throw CLI::ValidationError(option, e.what());
                             }
                         }
                     },
                     description))
            ->option_text(text);
    };
    add("--clamp", Mode::clamp,
        "Overwrite the activity of a group: 'Process/Group(x,y)=value' for one of its cells, with all others "
        "0; 'Process/Group=FILE' with a list of patterns, one in each cycle, over and over; behind either, "
        "'; every N' cycles, '; step N' patterns, '; times N' through the list, '; backwards', '; from "
        "WHEN', '; until WHEN' (as for --at). Or a table of rows cycle,process,group,v0,v1,... May be "
        "repeated",
        "PATTERN|FILE");
    add("--add", Mode::add, "The same, added to the activity after any clamp; other cells stay", "PATTERN");
    add("--multiply", Mode::multiply, "The same, multiplied with the activity at last; other cells stay",
        "PATTERN");
}

CLI::Option* add_picture_format(CLI::App& command, std::string& format) {
    return command.add_option("--as", format, "Format of pictures: png, svg or pdf [png]")
        ->check(CLI::IsMember({"png", "svg", "pdf"}))
        ->option_text("FORMAT");
}

void add_recording(CLI::App& run, RunOptions& o) {
    auto* record =
        repeated(run.add_option_function<std::vector<std::string>>(
                     "-r,--record",
                     [&o](const std::vector<std::string>& texts) {
                         for (const auto& text : texts) o.recordings.push_back({{text}});
                     },
                     "Write 'Process/Group' (its activity) or 'Process/Group:state' to a file; "
                     "'...(x1..x2,y1..y2)' for some of its cells, 'mean:...' for their mean, '...=NAME.h5' "
                     "to name the file; may be repeated"))
            ->option_text("SOURCE");
    run.add_option(
           "--format", o.record.format,
           "Of recordings without a named file: csv, npy, npz (NumPy), h5 (HDF5) or dat (the original's "
           "data sampler) [csv]")
        ->check(CLI::IsMember({"csv", "npy", "npz", "h5", "dat"}))
        ->option_text("FORMAT")
        ->needs(record);
    run.add_option_function<std::uint64_t>(
           "--every",
           [&o](const std::uint64_t& every) {
               for (auto& r : o.recordings) r.every = every;
           },
           "Record every K-th cycle [1]")
        ->check(count())
        ->option_text("K")
        ->needs(record);
    run.add_flag("--record-mean", o.record.mean, "Record the mean of K cycles instead of every K-th")
        ->needs("--every");
    run.add_option("--record-from", o.record.from, "Record from this cycle on [0]")
        ->check(seed())
        ->option_text("CYCLE")
        ->needs(record);
    run.add_option("--record-until", o.record.until, "Record up to this cycle")
        ->check(seed())
        ->option_text("CYCLE")
        ->needs(record);
    repeated(run.add_option_function<std::vector<std::string>>(
                 "-p,--plot",
                 [&o](const std::vector<std::string>& texts) {
                     for (const auto& text : texts) o.plots.push_back({text});
                 },
                 "Draw a picture: 'time:SOURCE', 'space:SOURCE@CYCLES', 'movie:SOURCE', 'connection:NAME' "
                 "or 'diagram', see 'forage plot --help'; may be repeated"))
        ->option_text("PLOT");
    add_picture_format(run, o.picture_format);
}

void add_plot(CLI::App& app, PlotOptions& o) {
    auto& plot = *app.add_subcommand("plot", "Draw pictures of results, of a recording or of a system");
    plot.footer(
        "Plots:\n"
        "  time:SOURCE                     cells over time; 'time:mean:SOURCE' for their mean\n"
        "  space:SOURCE@100,200            the group as a picture at these cycles; at the last one without "
        "'@'\n"
        "  space:SOURCE@0..1000/100        at every 100th cycle; ';blocks=9x1' at the end divides the group\n"
        "  movie:SOURCE@0..500/5           the same as an animated PNG\n"
        "  connection:NAME                 which cells reach which, with strength and delay\n"
        "  diagram, diagram:PROCESS        the system as the file lays it out\n"
        "  trajectory                      the robot's paths\n"
        "A source is 'Process/Group:state(x1..x2,y1..y2)'; state and cells may be left out.\n"
        "Example:\n"
        "  forage plot systems/reactive_foraging.iqr diagram 'connection:US to Approach' --as svg");
    plot.add_option("FROM", o.source, "Directory of results, recording (.csv, .npy, .h5) or system (.iqr)")
        ->required()
        ->option_text("DIR|FILE");
    plot.add_option("PLOT", o.wishes, "What to draw; without any, what there is")->option_text("PLOT...");
    plot.add_option("-o,--output", o.directory, "Directory for pictures [beside what they show]")
        ->option_text("DIR");
    add_picture_format(plot, o.picture_format);
}

void add_run(CLI::App& app, RunOptions& o) {
    auto& run = *app.add_subcommand("run", "Run a system, in a world if one is given");
    run.footer(
        "Without --cycles, --seconds or --trials it runs for 60 seconds of the world.\n"
        "Example:\n"
        "  forage run systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world --trials 30\n"
        "  ... --at 'trial 10: Motor In to Motor.weight=0.5' --at 'max(Bug/Light) > 0.9: "
        "Bug/Light.threshold=1'");
    add_input(run, o.input);
    auto* cycles = run.add_option("-c,--cycles", o.cycles, "Stop after so many cycles")
                       ->check(count())
                       ->option_text("N");
    auto* seconds = run.add_option("--seconds", o.seconds, "Stop after so many seconds of the world")
                        ->check(positive())
                        ->option_text("S");
    auto* trials = run.add_option("-t,--trials", o.trials,
                                  "Stop after so many trials; a trial ends when the robot is reset")
                       ->check(count())
                       ->option_text("N");
    cycles->excludes(seconds)->excludes(trials);
    seconds->excludes(trials);
    run.add_option("--longest-trial", o.longest_trial,
                   "Give up when a trial takes longer, in seconds of the world [300]")
        ->check(positive())
        ->option_text("S")
        ->needs(trials);
    run.add_option("--seed", o.input.seed, "Decides everything random [1]")->check(seed())->option_text("N");
    add_recording(run, o);
    run.add_option("--until", o.until.text, "Stop before its time when a condition holds, as for --at")
        ->option_text("WHEN");
    repeated(
        run.add_option_function<std::vector<std::string>>(
            "--at",
            [&o](const std::vector<std::string>& texts) {
                for (const auto& text : texts) {
                    if (const auto wish = parse_timed(text)) {
                        o.at.push_back(*wish);
                        continue;
                    }
                    throw CLI::ValidationError(
                        "--at", fmt::format("'{}' is not a condition, a colon, a blank and a change, such as "
                                            "'trial >= 200: Selection/Adaptive.excGain=0'",
                                            text));
                }
            },
            "Change a parameter while it runs, when a condition first holds: 'cycle N', 'trial N', 'N s', or "
            "comparisons of cycle, trial, seconds, cells 'Process/Group(x,y)' and mean(Process/Group), also "
            "sum, min and max, joined by && and ||; may be repeated"))
        ->option_text("'WHEN: WHERE=VALUE'");
    run.add_option("--drive", o.input.drive,
                   "Table that modules of type moduleReplay play: cycle,process,target,v0,v1,...")
        ->option_text("FILE");
    add_manipulations(run, o);
    run.add_option("-o,--output", o.directory, "Directory for results [forage-out]; '' for none")
        ->option_text("DIR");
    run.add_option("--world-pace", o.input.world_pace,
                   "Seconds of the world per second of the clock, instead of the world's own")
        ->check(positive())
        ->option_text("X")
        ->needs("--world");
    run.add_flag_callback(
        "--no-noise", [&o] { o.input.noise = false; },
        "Motors and sensors without noise; start positions still vary");
    run.add_flag("--sensor-rates", o.input.sensor_rates,
                 "Scans and pictures as often as the world's sensors say, instead of in every cycle")
        ->needs("--world");
    run.add_option("--latency", o.input.latency, "What robots sense comes so many cycles later [0]")
        ->check(CLI::Range(0, 1000))
        ->option_text("CYCLES")
        ->needs("--world");
    run.add_flag("--game", o.input.game,
                 "Play the robotics challenge: two teams collect resources for five minutes")
        ->needs("--world");
    run.add_option(
           "--video", o.video,
           "Film the world from above, with what the robots see: an animated .gif, or numbered .png files")
        ->option_text("FILE")
        ->needs("--world");
    run.add_option("--threads", o.threads, "For large systems; the numbers do not depend on it [1]")
        ->check(count())
        ->option_text("N");
    run.add_option_function<std::string>(
           "--checkpoint-every", [&o](const std::string& text) { o.checkpoint_every = parse_interval(text); },
           "Write a checkpoint every N cycles, or every 'N s' of the world: after a stop, be it a power cut, "
           "'forage resume' goes on from there")
        ->option_text("N")
        ->excludes("--video");  // a film cannot go on
    run.add_option(
           "--on-nan", o.on_nan,
           "When a number becomes NaN or infinite: 'warn' once and go on, 'stop', or 'ignore' it [warn]")
        ->transform(CLI::CheckedTransformer(std::map<std::string, OnNan>{{"warn", OnNan::warn},
                                                                         {"stop", OnNan::stop},
                                                                         {"ignore", OnNan::ignore}})
                        .description(""))
        ->option_text("HOW");
    run.add_flag("--hash", o.hash, "Give a digest of the state at the end: equal runs have the same one");
    run.add_flag("--realtime", o.real_time, "No faster than the clock: one second of the world per second");
    run.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

void add_resume(CLI::App& app, ResumeOptions& o) {
    auto& resume = *app.add_subcommand("resume", "Go on with a run that was stopped, from its checkpoint");
    resume.footer(
        "What the run leaves behind is then the same, byte for byte, as if it had never been stopped.\n"
        "Example:\n"
        "  forage resume forage-out");
    resume.add_option("FROM", o.path, "Directory of results, or one of the checkpoints in it")
        ->required()
        ->option_text("DIR|FILE");
    resume.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

RunOptions parse_run(std::vector<std::string> arguments) {
    CLI::App app;
    RunOptions options;
    add_run(app, options);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    app.parse(arguments);
    return options;
}

void add_tutorial(CLI::App& app, TutorialOptions& o) {
    auto& tutorial = *app.add_subcommand("tutorial", "List the exercises of the tutorial, or run one");
    tutorial.footer(
        "docs/tutorial has the text, the questions and their solutions.\n"
        "Example:\n"
        "  forage tutorial 3.1");
    tutorial.add_option("EXERCISE", o.exercise, "Its number")->option_text(" ");
    tutorial.add_option("-o,--output", o.directory, "Directory for results [forage-out/tutorial/EXERCISE]")
        ->option_text("DIR");
}

void add_experiment(CLI::App& app, ExperimentOptions& o) {
    auto& experiment = *app.add_subcommand(
        "experiment", "Run a system many times, over seeds and parameters, on all cores, into one table");
    experiment.footer(
        "What was finished before an interruption is not repeated. docs/reference/experiment.md says what\n"
        "stands in FILE.\n"
        "Example:\n"
        "  forage experiment systems/light_threshold.xml");
    experiment.add_option("FILE", o.file, "Experiment file (.xml)")->required()->option_text(" ");
    experiment.add_option("-o,--output", o.directory, "Directory for results [forage-out/ and FILE's name]")
        ->option_text("DIR");
    experiment.add_option("-j,--jobs", o.jobs, "Runs at a time [one per core]")
        ->check(count())
        ->option_text("N");
    add_plugins(experiment, o.plugins);
    experiment.add_flag("--fresh", o.fresh, "Repeat runs that are finished");
    experiment.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

void add_convert(CLI::App& app, ConvertOptions& o) {
    auto& convert =
        *app.add_subcommand("convert", "Read a system or process file and write it in the standard layout");
    convert.footer(
        "Example:\n"
        "  forage convert systems/reactive_foraging.iqr bug.iqrProcess --extract Bug");
    convert.add_option("IN", o.input, "File to read (.iqr or .iqrProcess)")->required()->option_text("FILE");
    convert.add_option("OUT", o.output, "File to write (.iqr or .iqrProcess); may be the same")
        ->required()
        ->option_text("FILE");
    repeated(convert.add_option("--import", o.imports,
                                "Add a copy of a process from an .iqrProcess file; may be repeated"))
        ->option_text("FILE");
    convert
        .add_option("--extract", o.extract, "Write this process alone, with the connections among its groups")
        ->option_text("PROCESS");
    add_plugins(convert, o.plugins);
    convert.add_flag("--embed", o.embed, "Write the content of linked processes instead of the links");
    convert.add_flag("--lenient", o.lenient, "Unknown elements and attributes are warnings, and left out");
}

void add_new(CLI::App& app, std::string& kind, std::string& name) {
    auto& command = *app.add_subcommand("new", "Write a small project with a type of your own");
    command.footer("Example:\n  forage new neuron adaptive");
    command.add_option("KIND", kind, "neuron, synapse or module")
        ->required()
        ->check(CLI::IsMember({"neuron", "synapse", "module"}))
        ->option_text(" ");
    command.add_option("NAME", name, "Name of the folder, and of the type after its kind")
        ->required()
        ->option_text(" ");
}

void add_build_plugin(CLI::App& app, BuildPluginOptions& o) {
    auto& command = *app.add_subcommand("build-plugin", "Compile a source file with types of your own");
    command.footer(
        "The compiler is the one that CXX names, or c++.\nExample:\n  forage build-plugin adaptive.cpp");
    command.add_option("FILE", o.source, "Source file (.cpp)")->required()->option_text(" ");
    command.add_option("-o,--output", o.output, "Plugin to write [plugins/NAME.so beside FILE]")
        ->option_text("FILE");
}

/// What was probably meant by the first word of the command line that does not exist; empty when all do.
std::string suggestion(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> commands, options;
    for (const auto* c : app.get_subcommands([](const CLI::App*) { return true; }))
        commands.push_back(c->get_name());
    if (argc < 2) return {};
    const auto found = app.get_subcommands([&](const CLI::App* c) { return c->get_name() == argv[1]; });
    const CLI::App* command = found.empty() ? nullptr : found.front();
    if (!command) return std::string(argv[1]).starts_with("-") ? "" : forage::suggest(argv[1], commands);
    for (const auto* o : command->get_options())
        for (const auto& name : o->get_lnames()) options.push_back("--" + name);
    for (int i = 2; i < argc; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        if (word.starts_with("--") && std::find(options.begin(), options.end(), word) == options.end())
            return fmt::format(
                "there is no option '{}'{}", word,
                forage::nearest(word, options).empty() ? "" : ", " + forage::suggest(word, options));
    }
    return {};
}

}  // namespace

namespace {

int program(int argc, char** argv) {
    CLI::App app("Runs iqr brain models headless, in a closed loop with a simulated robot.", "forage");
    app.set_version_flag("--version", "forage " FORAGE_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);

    RunOptions run_options;
    ExperimentOptions experiment_options;
    ConvertOptions convert_options;
    PlotOptions plot_options;
    Input check_input, describe_input;
    std::string type;
    add_run(app, run_options);
    ResumeOptions resume_options;
    add_resume(app, resume_options);
    add_experiment(app, experiment_options);
    TutorialOptions tutorial_options;
    add_tutorial(app, tutorial_options);
    add_plot(app, plot_options);
    add_convert(app, convert_options);
    BuildPluginOptions build_options;
    std::string new_kind, new_name;
    add_new(app, new_kind, new_name);
    add_build_plugin(app, build_options);
    auto& check_command =
        *app.add_subcommand("check", "Check a system (and world) and say everything that is wrong with it");
    add_input(check_command, check_input);
    auto& describe_command = *app.add_subcommand(
        "describe", "Show what a system is made of: processes, groups, connections, sizes");
    describe_command.footer("Example:\n  forage describe systems/reactive_foraging.iqr");
    add_input(describe_command, describe_input);
    check_command.footer(
        "Example:\n  forage check systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world");
    WorldCommand world_options;
    auto& world_command =
        *app.add_subcommand("world", "Check a world, list what is in it and draw it from above");
    world_command.footer(
        "Example:\n  forage world systems/worlds/basic_arena.world -o forage-out/basic_arena.png");
    world_command.add_option("FILE", world_options.file, "World file (.world)")->required()->option_text(" ");
    world_command
        .add_option("-o,--output", world_options.picture, "Picture (.png, .svg or .pdf) [FILE's name .png]")
        ->option_text("PICTURE");
    world_command.add_flag("--game", world_options.game, "With the robotics challenge's resources");
    std::string directory = "forage-out";
    auto& view_command = *app.add_subcommand(
        "view", "Write a page, index.html, that shows the pictures and tables of results");
    view_command.footer("Example:\n  forage view forage-out");
    view_command.add_option("DIR", directory, "Directory of results [forage-out]")->option_text(" ");
    auto& types_command =
        *app.add_subcommand("types", "List the neuron, synapse and module types, or describe one");
    types_command.footer("Example:\n  forage types neuronLinearThreshold");
    types_command.add_option("NAME", type, "The type to describe")->option_text(" ");
    auto& schema_command =
        *app.add_subcommand("schema", "Print a RELAX NG schema of system files, for editors");
    schema_command.footer("Example:\n  forage schema > iqr.rng");
    std::string shell;
    auto& completion_command =
        *app.add_subcommand("completion", "Print a script that completes command lines");
    completion_command.footer(
        "Example:\n  forage completion bash > ~/.local/share/bash-completion/completions/forage");
    completion_command.add_option("SHELL", shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}))
        ->option_text(" ");
    app.add_subcommand("man", "Print the manual page")
        ->footer("Example:\n  forage man > forage.1; man ./forage.1");
    std::vector<std::string> plugins;
    add_plugins(types_command, plugins);
    add_plugins(schema_command, plugins);

    try {
        if (argc == 1) {
            fmt::print(stderr, "{}", app.help());
            return bad_input;
        }
        if (argc == 2 && std::string_view(argv[1]) == "help") throw CLI::CallForHelp();
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::RequiredError& e) {
        const bool no_command = app.get_subcommands().empty() && !std::string_view(argv[1]).starts_with("-");
        const std::string meant = suggestion(app, argc, argv);
        fmt::print(stderr, "error: {}\n  hint: {}\n",
                   no_command ? fmt::format("there is no command '{}'", argv[1]) : e.what(),
                   meant.empty() ? "'forage --help' lists what there is" : meant);
        return bad_input;
    } catch (const CLI::ParseError& e) {
        const std::string meant = suggestion(app, argc, argv);
        const auto parsed = app.get_subcommands();
        fmt::print(stderr, "error: {}\n  hint: {}\n", e.what(),
                   !meant.empty() ? meant
                                  : fmt::format("'forage {}--help' lists what there is",
                                                parsed.empty() ? "" : parsed.front()->get_name() + " "));
        return bad_input;
    }
    try {
        if (app.got_subcommand("run")) {
            run_options.arguments.assign(argv + 1, argv + argc);
            return run(run_options);
        }
        if (app.got_subcommand("resume")) return resume(resume_options, parse_run);
        if (app.got_subcommand("tutorial")) return tutorial(tutorial_options);
        if (app.got_subcommand("experiment")) return experiment(experiment_options);
        if (app.got_subcommand("plot")) return plot(plot_options);
        if (app.got_subcommand("check")) return check(check_input);
        if (app.got_subcommand("world")) return world(world_options);
        if (app.got_subcommand("describe")) return describe(describe_input);
        if (app.got_subcommand("convert")) return convert(convert_options);
        if (app.got_subcommand("view")) return view(directory);
        if (app.got_subcommand("man")) return fmt::print("{}", man_page(app)), fine;
        if (app.got_subcommand("completion")) return fmt::print("{}", completion(app, shell)), fine;
        if (app.got_subcommand("new")) return new_project(new_kind, new_name);
        if (app.got_subcommand("build-plugin")) return build_plugin(build_options);
        if (app.got_subcommand("schema")) return schema(plugins);
        return types(type, plugins);
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return run_failed;
    }
}

}  // namespace

int main(int argc, char** argv) {
    int status = run_failed;
    try {
        status = program(argc, argv);
    } catch (const std::exception& e) {  // of the last words themselves
        std::fprintf(stderr, "error: %s\n", e.what());
    }
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
    std::fprintf(stderr, "error: cannot write to the standard output: %s\n", std::strerror(errno));
    return status == fine ? run_failed : status;
}
