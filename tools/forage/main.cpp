// forage: run and check iqr systems from the command line.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/diagnostic.h"
#include "core/base/print.h"
#include "core/model/lookup.h"
#include "core/run/input_error.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

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

    Program commands(app, argv);
    for (const auto add :
         {add_run,      add_explain, add_resume, add_rerun,  add_experiment,   add_tutorial,   add_plot,
          add_convert,  add_edit,    add_new,    add_studio, add_build_plugin, add_trust,      add_check,
          add_describe, add_world,   add_view,   add_types,  add_schema,       add_completion, add_man})
        add(commands);

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
        return commands.execute();
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
