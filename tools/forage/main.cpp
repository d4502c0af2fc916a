// forage: run and check iqr systems from the command line.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/diagnostic.h"
#include "core/base/print.h"
#include "core/model/lookup.h"
#include "core/run/input_error.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"
#include "tools/forage/reference.h"

namespace {

using namespace forage::tool;
using forage::print;

/// The word that the first unknown word of the command line probably means; empty when all words are known.
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
        if (word.starts_with("--") && std::ranges::find(options, word) == options.end())
            return fmt::format(
                "there is no option '{}'{}", word,
                forage::nearest(word, options).empty() ? "" : ", " + forage::suggest(word, options));
    }
    return {};
}

/// A hint that names the help of the command.
std::string help_of(const CLI::App& app) {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? "'forage --help' lists the commands"
                          : fmt::format("'forage {} --help' lists the options", parsed.front()->get_name());
}

int program(int argc, char** argv) {
    char help[] = "--help";
    char* help_of_command[] = {argv[0], argv[argc - 1], help};
    if (argc == 3 && std::string_view(argv[1]) == "help") argv = help_of_command;
    CLI::App app("Runs iqr brain models headless, in a closed loop with a simulated robot.", "forage");
    app.set_version_flag("--version", "forage " FORAGE_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);

    std::map<std::string, std::function<int()>> commands;
    const auto add = [&]<class Options>(void (*declare)(CLI::App&, Options&), auto execute) {
        const auto options = std::make_shared<Options>();
        declare(app, *options);
        const auto all = app.get_subcommands([](const CLI::App*) { return true; });
        commands[all.back()->get_name()] = [=] { return execute(*options); };
    };
    add(add_run, [&](RunOptions& o) { return o.spec.arguments.assign(argv + 1, argv + argc), run(o); });
    add(add_explain, run);
    add(add_resume, [](const ResumeOptions& o) { return resume(o, parse_run); });
    add(add_rerun, [](const RerunOptions& o) { return rerun(o, parse_run); });
    add(add_experiment, experiment);
    add(add_tutorial, tutorial);
    add(add_plot, plot);
    add(add_convert, convert);
    add(add_edit, edit);
    add(add_new, create);
    add(add_studio, [&](const StudioCommand&) { return studio(argv); });
    add(add_build_plugin, build_plugin);
    add(add_trust, trust);
    forage::RunInput check_input;
    DescribeOptions describe_options;
    std::string type;
    auto& check_command =
        *app.add_subcommand("check", "Check a system (and a world) and report all mistakes");
    add_input(check_command, check_input);
    auto& describe_command =
        *app.add_subcommand("describe", "Show the processes, groups and connections of a system, with sizes");
    describe_command.footer(
        "Example:\n"
        "  forage describe systems/reactive_foraging.iqr\n"
        "  forage describe systems/reactive_foraging.iqr --format latex > reactive_foraging.tex");
    add_input(describe_command, describe_options.input);
    add_value(describe_command, "--format", describe_options.format, "FORMAT",
              "text; for papers: markdown or latex (tables), dot (a graph for Graphviz); for programs: "
              "json [text]")
        ->check(one_of({"text", "markdown", "latex", "dot", "json"}));
    for (const char* format : {"markdown", "latex", "dot", "json"})
        describe_command.add_flag_callback(
            std::string("--") + format, [&, format] { describe_options.format = format; },
            std::string("The same as --format ") + format);
    check_command.footer(
        "Example:\n  forage check systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world");
    WorldCommand world_options;
    auto& world_command = *app.add_subcommand(
        "world", "Check a world, list its contents and draw it from above; or the data sheet of a robot");
    world_command.footer(
        "Example:\n"
        "  forage world systems/worlds/basic_arena.world -o forage-out/basic_arena.png\n"
        "  forage world systems/worlds/basic_arena.world --robot Bug -o forage-out/bug.png");
    add_value(world_command, "FILE", world_options.file, " ", "World file (.world)")->required();
    add_value(world_command, "-o,--output", world_options.picture, "PICTURE",
              "Picture (.png, .svg or .pdf) [FILE's or ROBOT's name with .png]")
        ->check(named("file"));
    add_value(world_command, "--robot", world_options.robot, "ROBOT",
              "Print and draw the data sheet of this robot: what every cell of its motors and sensors means");
    world_command.add_flag("--game", world_options.game, "With the robotics challenge's resources");
    std::string directory = "forage-out";
    auto& view_command =
        *app.add_subcommand("view", "Write a page, index.html, with the pictures and tables of results");
    view_command.footer("Example:\n  forage view forage-out");
    add_value(view_command, "DIR", directory, " ", "Directory of results [forage-out]");
    auto& types_command = *app.add_subcommand(
        "types",
        "List the neuron, synapse and module types, or describe one, or those that a system declares");
    types_command.footer("Example:\n  forage types neuronLinearThreshold\n  forage types model.iqr");
    add_value(types_command, "NAME", type, " ", "The type to describe, or a system file (.iqr)");
    auto& schema_command =
        *app.add_subcommand("schema", "Print a RELAX NG schema of system files, for editors");
    schema_command.footer("Example:\n  forage schema > iqr.rng");
    SchemaOptions schema_options;
    schema_command.add_flag("--experiment", schema_options.of_experiments,
                            "The schema of experiment files instead");
    schema_command.add_flag("--markdown", schema_options.markdown,
                            "The elements of system files and the types, as tables in Markdown, instead");
    std::string shell;
    auto& completion_command =
        *app.add_subcommand("completion", "Print a script that completes command lines");
    completion_command.footer(
        "Example:\n  forage completion bash > ~/.local/share/bash-completion/completions/forage");
    add_value(completion_command, "SHELL", shell, " ", "bash, zsh or fish")
        ->required()
        ->check(one_of({"bash", "zsh", "fish"}));
    app.add_subcommand("man", "Print the manual page")
        ->footer("Example:\n  forage man > forage.1; man ./forage.1");
    std::vector<std::string> plugins;
    add_plugins(types_command, plugins);
    add_plugins(schema_command, schema_options.plugins);

    try {
        if (argc == 1) {
            print(stderr, "{}", app.help());
            return bad_input;
        }
        if (argc == 2 && std::string_view(argv[1]) == "help") return print("{}", app.help()), fine;
        auto words = current_names({argv + 1, argv + argc});
        std::ranges::reverse(words);  // as CLI11 takes them
        app.parse(words);
    } catch (const CLI::ParseError& e) {  // also a call for help
        const bool no_command = app.get_subcommands().empty() && !std::string_view(argv[1]).starts_with("-");
        if (e.get_exit_code() == 0 && !no_command) return app.exit(e);
        const std::string meant = suggestion(app, argc, argv);
        print(stderr, "error: {}\n  hint: {}\n",
              no_command ? fmt::format("there is no command '{}'", argv[1]) : e.what(),
              !meant.empty() ? meant : help_of(app));
        return bad_input;
    }
    try {
        if (const auto it = commands.find(app.get_subcommands().front()->get_name()); it != commands.end())
            return it->second();
        if (app.got_subcommand("check")) return check(check_input);
        if (app.got_subcommand("world")) return world(world_options);
        if (app.got_subcommand("describe")) return describe(describe_options);
        if (app.got_subcommand("view")) return view(directory);
        if (app.got_subcommand("man")) return print("{}", man_page(app)), fine;
        if (app.got_subcommand("completion")) return print("{}", completion(app, shell)), fine;
        if (app.got_subcommand("schema")) return schema(schema_options);
        return types(type, plugins);
    } catch (const forage::InputError& e) {  // its text has the words "error" and "hint"
        print(stderr, "{}", e.what());
        return run_failed;
    } catch (const std::exception& e) {
        print(stderr, "error: {}\n", e.what());
        return run_failed;
    }
}

}  // namespace

int main(int argc, char** argv) {
    int status = run_failed;
    try {
        status = program(argc, argv);
    } catch (const std::exception& e) {  // an exception while printing
        std::fprintf(stderr, "error: %s\n", e.what());
    }
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
    std::fprintf(stderr, "error: cannot write to the standard output: %s\n", std::strerror(errno));
    return status == fine ? run_failed : status;
}
