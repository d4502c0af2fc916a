#include "tools/forage/options.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/run/experiment/parts.h"

namespace forage::tool {
namespace {

/// A validator for a number that `fits`; the error says what is expected.
CLI::Validator number_that(bool (*fits)(double), const char* description) {
    return CLI::Validator(
        [=](std::string& text) {
            const auto value = parse_number<double>(text);
            if (!value || !fits(*value)) return fmt::format("'{}' is not {}", text, description);
            // 1e6 is a whole number as well.
            if (const double v = *value; v == std::floor(v) && v < 1e15)
                text = fmt::format("{:.0f}", v);
            else if (v >= 1e15 && text.find_first_not_of("0123456789") != text.npos)
                return fmt::format("'{}' is too large to be written so: write all digits", text);
            return std::string();
        },
        "");
}

}  // namespace

CLI::Validator named(const std::string& what) {
    return {[what](const std::string& name) {
                return name.empty() ? fmt::format("no {} is named", what) : std::string();
            },
            ""};
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

CLI::Validator threads() {
    return number_that([](double v) { return v >= 1 && v <= 1024 && v == std::floor(v); },
                       "a whole number from 1 to 1024");
}
CLI::Validator one_of(std::vector<std::string> names) {
    const std::string set = fmt::format("{{{}}}", separated(names, ","));  // for completion
    return CLI::Validator(
        [names = std::move(names)](const std::string& text) {
            return std::ranges::find(names, text) != names.end()
                       ? std::string()
                       : fmt::format("'{}' is none of {}", text, separated(names, ", "));
        },
        set);
}

std::vector<std::string> current_names(std::vector<std::string> words) {
    static constexpr std::pair<std::string_view, std::string_view> renamed[] = {
        {"--as", "--plot-format"},
        {"--at", "--schedule"},
        {"--drive", "--replay"},
        {"--every", "--record-every"},
        {"--longest-trial", "--trial-timeout"},
        {"--world-pace", "--real-time-factor"}};
    for (auto& word : words)
        for (const auto& [old, current] : renamed)
            if (word == old || word.starts_with(std::string(old) + "="))
                word = std::string(current) + word.substr(old.size());
    return words;
}

CLI::Option* repeated(CLI::Option* option) {
    return option->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* add_texts(CLI::App& command, const char* name, std::vector<model::Expression>& list,
                       const char* description, const char* value) {
    const auto add = [&list](const std::vector<std::string>& texts) {
        for (const auto& text : texts) list.push_back({text});
    };
    return repeated(command.add_option_function<std::vector<std::string>>(name, add, description))
        ->option_text(value);
}

CLI::Option* add_plot_format(CLI::App& command, std::string& format) {
    return add_value(command, "--plot-format", format, "FORMAT", "Format of pictures: png, svg or pdf [png]")
        ->check(one_of({"png", "svg", "pdf"}));
}

void add_plugins(CLI::App& command, std::vector<std::string>& plugins) {
    repeated(command.add_option(
                 "--plugin", plugins,
                 "Plugin with more types (.so), or a folder of plugins, in addition to those in "
                 "FORAGE_PLUGIN_PATH and in the folder plugins beside the system, if 'forage trust' "
                 "has trusted it; may be repeated"))
        ->option_text("PATH");
}

void add_input(CLI::App& command, RunInput& input) {
    command
        .add_option_function<std::vector<std::string>>(
            "SYSTEM",
            [&input](const std::vector<std::string>& files) {
                input.system = files.front();
                input.more.assign(files.begin() + 1, files.end());
            },
            "System file (.iqr) or process file (.iqrProcess); several systems run together, in lock-step")
        ->required()
        ->expected(1, 1000)
        ->option_text("FILE...");
    add_value(command, "-w,--world", input.world, "FILE", "World in which the robot lives (.world)")
        ->check(named("file"));
    add_texts(command, "-s,--set", input.settings,
              "Change a parameter: 'Process/Group.parameter=value', 'Process.parameter=value' for a "
              "module, 'Connection.parameter=value' for a synapse; may be repeated",
              "WHERE=VALUE");
    add_texts(command, "--robot", input.robots,
              "Let the system's robot NAME (device_name) be another robot of the world; when several systems "
              "have a robot NAME, it is the first one that no earlier --robot has bound; may be repeated",
              "NAME=ROBOT");
    add_plugins(command, input.plugins);
    command.add_flag("--lenient", input.lenient,
                     "Warnings instead of errors for what the original accepts: unknown parameters and "
                     "attributes, unusual sizes of groups, several modules that write to one group");
}

void add_tutorial(CLI::App& app, TutorialOptions& o) {
    auto& tutorial = *app.add_subcommand("tutorial", "List the exercises of the tutorial, or run one");
    tutorial.footer(
        "docs/tutorial has the text, the questions and their solutions.\n"
        "Example:\n"
        "  forage tutorial 3.1\n"
        "  forage tutorial 2.2 --system mine.iqr");
    add_value(tutorial, "EXERCISE", o.exercise, " ",
              "Number of an exercise or of a part, or an experiment file");
    add_value(tutorial, "--system", o.system, "FILE",
              "Run the exercise on this system, and say what it still lacks; the exit status is 1 if "
              "it lacks something");
    add_value(tutorial, "-o,--output", o.directory, "DIR",
              "Directory for results [forage-out/tutorial/EXERCISE]")
        ->check(named("directory"));
}

void add_experiment(CLI::App& app, ExperimentOptions& o) {
    auto& experiment = *app.add_subcommand(
        "experiment", "Run a system many times, with different seeds and parameters, on all cores");
    experiment.footer(
        "Runs that were finished before an interruption are not repeated. docs/reference/experiment.md\n"
        "describes FILE.\n"
        "Example:\n"
        "  forage experiment systems/light_threshold.xml\n"
        "On a cluster (docs/how-to/cluster.md):\n"
        "  forage experiment systems/light_threshold.xml --slurm --partition short --time 1:00:00\n"
        "  forage experiment systems/light_threshold.xml --status");
    add_value(experiment, "FILE", o.file, " ", "Experiment file (.xml)")->required();
    add_value(experiment, "-o,--output", o.directory, "DIR",
              "Directory for results [forage-out/ and FILE's name]")
        ->check(named("directory"));
    add_value(experiment, "-j,--jobs", o.jobs, "N", "Number of simultaneous runs [one per core]")
        ->transform(threads());
    add_plugins(experiment, o.plugins);
    experiment.add_flag("--fresh", o.fresh, "Repeat finished runs");
    repeated(experiment.add_option(
                 "--table-format", o.formats,
                 "Write the results also as results.npy or results.h5: npy or hdf5; may be repeated"))
        ->check(one_of({"npy", "hdf5"}))
        ->option_text("FORMAT");
    auto* bundle = add_value(experiment, "--bundle", o.bundle, "FILE",
                             "Write everything that repeats the experiment, and its results, to one "
                             ".zip file for 'forage rerun' and for archives")
                       ->check(named("file"));
    experiment.add_flag("-q,--quiet", o.quiet, "Print errors only");
    const std::string cluster = "Many machines";
    auto* shard = experiment.add_option("--shard", o.shard, "Execute part I of N parts only, such as 3/10");
    shard->check(CLI::Validator(
        [](const std::string& text) {
            return parse_shard(text) ? std::string() : fmt::format("'{}' is not a part such as 3/10", text);
        },
        ""));
    shard->option_text("I/N")->group(cluster);
    auto* merge = experiment.add_flag("--merge", o.merge, "Write the tables of what the parts have left");
    auto* status = experiment.add_flag("--status", o.status, "Show how many runs are finished, and the rate");
    auto* slurm =
        experiment.add_flag("--slurm", o.slurm, "Submit all parts to Slurm, and a merge behind them");
    for (auto* flag : {merge, status, slurm}) flag->group(cluster)->excludes(shard);
    for (auto* flag : {shard, merge, status, slurm}) flag->excludes(bundle);
    merge->excludes(status)->excludes(slurm), status->excludes(slurm);
    add_value(experiment, "--after-round", o.after_round, "N",
              "With --merge, in the script of --slurm: when round N is complete and another one "
              "follows, submit it")
        ->needs(merge)
        ->group(cluster);
    experiment.add_flag("--dry-run", o.dry_run, "With --slurm: only write the scripts")
        ->needs(slurm)
        ->group(cluster);
    add_value(experiment, "--array-size", o.tasks, "N",
              "With --slurm: number of parts [100, or that of the runs]")
        ->needs(slurm)
        ->transform(count())
        ->group(cluster);
    const auto pass_on = [&](const char* name, const char* description, const char* value) {
        experiment
            .add_option_function<std::string>(
                name,
                [&o, option = std::string(name)](const std::string& v) {
                    o.sbatch.push_back(option + "=" + v);
                },
                description)
            ->needs(slurm)
            ->option_text(value)
            ->group(cluster);
    };
    pass_on("--partition", "With --slurm: the partition", "NAME");
    pass_on("--time", "With --slurm: the time limit of a part", "TIME");
    experiment
        .add_option_function<std::vector<std::string>>(
            "--sbatch",
            [&o](const std::vector<std::string>& more) {
                o.sbatch.insert(o.sbatch.end(), more.begin(), more.end());
            },
            "With --slurm: another option of sbatch, such as --account=ME")
        ->needs(slurm)
        ->allow_extra_args(false)
        ->option_text("OPTION")
        ->group(cluster);
}

void add_plot(CLI::App& app, PlotOptions& o) {
    auto& plot = *app.add_subcommand("plot", "Draw pictures of results, of a recording or of a system");
    plot.footer(
        "Plots:\n"
        "  time:SOURCE                     cells over time; 'time:mean(SOURCE)' for their mean\n"
        "  space:SOURCE@100,200            the group as a picture at these cycles; without '@' at the last "
        "one\n"
        "  space:SOURCE@0..1000/100        at every 100th cycle; ';blocks=9x1' at the end divides the group\n"
        "  movie:SOURCE@0..500/5           the same as an animated GIF\n"
        "  connection:NAME                 the synapses between two groups, with strength and delay\n"
        "  wiring:NAME                     the receptive field of each cell of a small group\n"
        "  connection:NAME@0,100           weights that are learned, at these cycles; also "
        "'wiring:NAME@0,100'\n"
        "  diagram, diagram:PROCESS        the diagram of the system or of one process\n"
        "  trajectory, trajectory@1..50    the robot's paths, or those of these trials\n"
        "  curve:MEASURE, heat:MEASURE     a measure of an experiment over one or two swept parameters\n"
        "  learning, learning:COLUMN       targets, or a column of trials.csv, over the trials\n"
        "  occupancy                       where the robot was in all trials, and its mean paths, by "
        "condition\n"
        "A source is 'Process/Group:state(x1..x2,y1..y2)'; state and cells are optional. 'NAME:weight(3,1)'\n"
        "is the synapse of a connection from the third cell of its source to the first of its target. See\n"
        "docs/reference/expressions.md.\n"
        "Example:\n"
        "  forage plot systems/reactive_foraging.iqr diagram 'connection:US to Approach' --plot-format svg");
    add_value(plot, "FROM", o.source, "DIR|FILE",
              "Directory of results, recording (.csv, .npy, .npz, .h5) or system (.iqr)")
        ->required();
    add_value(plot, "PLOT", o.plots, "PLOT...", "Plots to draw; without any, all that are possible");
    repeated(plot.add_option("--where", o.where,
                             "Of an experiment, draw only the runs with this value of a swept parameter or "
                             "of the seed: 'threshold=0.5', 'seed=1'; may be repeated"))
        ->option_text("NAME=VALUE");
    add_value(plot, "-o,--output", o.directory, "DIR", "Directory for pictures [beside FROM]")
        ->check(named("directory"));
    add_value(plot, "--layout", o.layout, "ROWSxCOLUMNS",
              "Draw the plots as panels a, b, c, ... of one figure, row by row: '2x3' are "
              "two rows of three panels");
    add_value(plot, "--width", o.width, "WIDTH",
              "Width of each picture: '600px', or in mm, such as 85 or 180 for one or two columns of a "
              "paper; PNG then has 300 dots per inch [that which suits its content]")
        ->check(named("width"));
    add_plot_format(plot, o.plot_format);
}

void add_convert(CLI::App& app, ConvertOptions& o) {
    auto& convert =
        *app.add_subcommand("convert", "Read a system or process file and write it in the standard layout");
    convert.footer(
        "Example:\n"
        "  forage convert systems/reactive_foraging.iqr bug.iqrProcess --extract Bug\n"
        "  forage convert systems/models/oja.iqr oja.cpp --as-plugin oja");
    add_value(convert, "IN", o.input, "FILE", "File to read (.iqr or .iqrProcess)")->required();
    add_value(convert, "OUT", o.output, "FILE",
              "File to write (.iqr or .iqrProcess; .cpp with --as-plugin); may be the same, or - to print it")
        ->required()
        ->check(named("file"));
    repeated(convert.add_option("--import", o.imports,
                                "Add a copy of a process from an .iqrProcess file; may be repeated"))
        ->option_text("FILE");
    add_value(convert, "--extract", o.extract, "PROCESS",
              "Write this process alone, with the connections among its groups");
    add_value(convert, "--as-plugin", o.as_plugin, "TYPE",
              "Write this type of the system as the source of a plugin that computes the same");
    add_plugins(convert, o.plugins);
    convert.add_flag("--embed", o.embed, "Write the content of linked processes instead of links");
    auto* terse = convert.add_flag(
        "--terse", o.terse,
        "Leave out what is the same in most systems, and write sizes and weights as attributes");
    convert.add_flag("--full", o.full, "Write what the file leaves out, and sizes and weights as elements")
        ->excludes(terse);
    convert.add_flag("--original", o.original,
                     "Write plain numbers instead of constants and formulas, and what the file leaves out "
                     "and the original iqr requires: patterns, arborizations, "
                     "functions, places in the diagram");
    convert.add_flag("--lenient", o.lenient,
                     "Unknown elements and attributes are warnings, and are not written");
}

void add_edit(CLI::App& app, EditOptions& o) {
    auto& command = *app.add_subcommand(
        "edit", "Edit a system or a world as the studio does; everything else in the file stays as it is");
    command.footer(
        "Example:\n"
        "  forage edit mine.iqr '{\"do\": \"parameter\", \"id\": \"light\", \"name\": \"threshold\", "
        "\"value\": 0.3}'\n"
        "docs/design/studio-protocol.md lists all operations, and the studio shows edits in this form.");
    add_value(command, "FILE", o.file, " ", "System or world (.iqr or .world)")->required();
    add_value(command, "OPERATIONS", o.operations, " ",
              "JSON: an operation or a list of them, or the name of a file with it")
        ->required();
    add_value(command, "-o,--output", o.output, "FILE", "File to write [FILE]")->check(named("file"));
    add_plugins(command, o.plugins);
}

void add_new(CLI::App& app, NewOptions& o) {
    auto& command = *app.add_subcommand(
        "new", "Write the beginning of a system, or a small project with a type of your own");
    command.footer("Example:\n  forage new system mine --robot\n  forage new neuron adaptive");
    add_value(command, "KIND", o.kind, " ", "system, neuron, synapse or module")
        ->required()
        ->check(one_of({"system", "neuron", "synapse", "module"}));
    add_value(command, "NAME", o.name, " ",
              "Name of the system, or of the folder and, after the kind, of the type");
    command.add_flag("--robot", o.robot, "A system with a robot, and a world for it");
}

void add_studio(CLI::App& app, StudioCommand& o) {
    auto& command = *app.add_subcommand(
        "studio", "Watch and touch a system while it runs, in the browser of this machine");
    command.footer(
        "Without SYSTEM, it opens the robot of the tutorial.\nExample:\n  forage studio "
        "systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world --open");
    add_input(command, o.input);
    command.get_option("SYSTEM")->required(false);
    add_value(command, "--seed", o.input.seed, "N", "Decides everything random [1]")->transform(seed());
    add_value(command, "--plot-config", o.plot_config, "FILE",
              "Layout that the page begins with (.layout.json), or plots of the original (.conf)")
        ->check(CLI::ExistingFile);
    add_value(command, "--port", o.port, "N", "Port on 127.0.0.1 [a free one]")->check(CLI::Range(0, 65535));
    command.add_flag("-r,--run", o.running, "Begin to run at once");
    command.add_flag("--recover", o.recover, "Resume the session of this system that was killed");
    command.add_flag("--open", o.open, "Open the browser");
}

void add_build_plugin(CLI::App& app, BuildPluginOptions& o) {
    auto& command = *app.add_subcommand("build-plugin", "Compile a source file with types of your own");
    command.footer(
        "The compiler is the one in CXX, or c++; CXXFLAGS are added.\nExample:\n  forage build-plugin "
        "adaptive.cpp");
    add_value(command, "FILE", o.source, " ", "Source file (.cpp)")->required();
    add_value(command, "-o,--output", o.output, "FILE", "Plugin to write [plugins/NAME.so beside FILE]")
        ->check(named("file"));
    command.add_flag("--debug", o.debug, "For a debugger; the plugin checks each index, and is slower");
}

void add_trust(CLI::App& app, TrustOptions& o) {
    auto& command = *app.add_subcommand("trust", "List the folders whose plugins are loaded, or add one");
    command.footer(
        "Plugins are programs. A run loads those in the folder plugins beside its system only if this folder "
        "is trusted;\n--plugin PATH and FORAGE_PLUGIN_PATH need no trust.\nExample:\n  forage trust plugins");
    add_value(command, "FOLDER", o.folder, " ", "Folder with plugins (.so), or with a folder plugins");
    command.add_flag("--remove", o.remove, "Trust it no longer");
}

}  // namespace forage::tool
