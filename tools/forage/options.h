// The options of the commands, for CLI11. Each function add_... adds a command to `app`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/forage/commands.h"

namespace forage::tool {

// Checks of values that several commands use.
/// A name that is not empty, of `what`: "file", "directory".
CLI::Validator named(const std::string& what);
CLI::Validator positive();  ///< a number above 0, at most 1e9
CLI::Validator count();     ///< a whole number, at least 1
CLI::Validator seed();      ///< a whole number, at least 0
CLI::Validator threads();   ///< a whole number from 1 to 1024
CLI::Validator one_of(std::vector<std::string> names);
/// Replaces the option names of version 0.1 in a command line by their current names. The old names are
/// accepted for one version.
std::vector<std::string> current_names(std::vector<std::string> words);
/// Adds an option whose value the help calls `value`.
template <class T>
CLI::Option* add_value(CLI::App& command, const char* name, T& to, const char* value,
                       const char* description) {
    return command.add_option(name, to, description)->option_text(value);
}
/// Makes an option repeatable, with one value each time.
CLI::Option* repeated(CLI::Option* option);
/// Adds a repeatable option; each of its values is added to `list`.
CLI::Option* add_texts(CLI::App& command, const char* name, std::vector<model::Expression>& list,
                       const char* description, const char* value);
CLI::Option* add_plot_format(CLI::App& command, std::string& format);
void add_plugins(CLI::App& command, std::vector<std::string>& plugins);
/// Adds the options for systems, world, settings and plugins.
void add_input(CLI::App& command, RunInput& input);

void add_run(CLI::App& app, RunOptions& o);
void add_explain(CLI::App& app, RunOptions& o);
void add_resume(CLI::App& app, ResumeOptions& o);
void add_rerun(CLI::App& app, RerunOptions& o);
/// Parses the options of `forage run`. `arguments` are the words after the program's name.
RunOptions parse_run(std::vector<std::string> arguments);
void add_tutorial(CLI::App& app, TutorialOptions& o);
void add_experiment(CLI::App& app, ExperimentOptions& o);
void add_plot(CLI::App& app, PlotOptions& o);
void add_convert(CLI::App& app, ConvertOptions& o);
void add_edit(CLI::App& app, EditOptions& o);
void add_new(CLI::App& app, NewOptions& options);
void add_studio(CLI::App& app, StudioCommand& options);
void add_build_plugin(CLI::App& app, BuildPluginOptions& o);
void add_trust(CLI::App& app, TrustOptions& o);

}  // namespace forage::tool
