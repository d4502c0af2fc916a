// The options of the commands, as CLI11 knows them. Each add_... gives `app` its command.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/forage/commands.h"

namespace forage::tool {

// What commands share.
CLI::Validator positive();  ///< a number above 0, at most 1e9
CLI::Validator count();     ///< a whole number, at least 1
CLI::Validator seed();      ///< a whole number, at least 0
CLI::Validator threads();   ///< a whole number from 1 to 1024
CLI::Validator one_of(std::vector<std::string> names);
/// The words of a command line with the options of version 0.1 under their current names: the old names remain understood for
/// one version.
std::vector<std::string> current_names(std::vector<std::string> words);
/// An option that may be repeated, with one value each time.
CLI::Option* repeated(CLI::Option* option);
CLI::Option* add_plot_format(CLI::App& command, std::string& format);
void add_plugins(CLI::App& command, std::vector<std::string>& plugins);
/// Systems, world, settings and plugins.
void add_input(CLI::App& command, RunInput& input);

void add_run(CLI::App& app, RunOptions& o);
void add_resume(CLI::App& app, ResumeOptions& o);
/// The options of `run` from the words behind the program's name.
RunOptions parse_run(std::vector<std::string> arguments);
void add_tutorial(CLI::App& app, TutorialOptions& o);
void add_experiment(CLI::App& app, ExperimentOptions& o);
void add_plot(CLI::App& app, PlotOptions& o);
void add_convert(CLI::App& app, ConvertOptions& o);
void add_new(CLI::App& app, std::string& kind, std::string& name);
void add_build_plugin(CLI::App& app, BuildPluginOptions& o);

}  // namespace forage::tool
