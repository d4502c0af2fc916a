// The commands of the program, and what they share for reading options with CLI11.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
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
/// Replaces the option names of version 0.1 in a command line by their current names. The old ones are
/// accepted until version 2.
std::vector<std::string> current_names(std::vector<std::string> words);
/// Adds an option whose value the help calls `value`.
template <class T>
CLI::Option* add_value(CLI::App& command, const char* name, T& to, const char* value,
                       const char* description) {
    return command.add_option(name, to, description)->option_text(value);
}
/// Makes an option repeatable, with one value each time.
CLI::Option* repeated(CLI::Option* option);
/// Adds a repeatable option; `take` gets each of its values.
CLI::Option* add_each(CLI::App& command, const char* name, std::function<void(const std::string&)> take,
                      const char* value, const char* description);
/// Adds a repeatable option; each of its values is added to `list`.
CLI::Option* add_texts(CLI::App& command, const char* name, std::vector<model::Expression>& list,
                       const char* description, const char* value);
CLI::Option* add_plot_format(CLI::App& command, std::string& format);
void add_plugins(CLI::App& command, std::vector<std::string>& plugins);
/// Adds the options for systems, world, settings and plugins.
void add_input(CLI::App& command, RunInput& input);

/// Adds the command `studio`, which two programs have.
CLI::App& declare_studio(CLI::App& app, StudioCommand& o);

/// A command, and its options, which live as long as the program.
template <class Options>
struct Command {
    CLI::App& app;
    Options& options;
};

/// The commands of the program, and what each of them does.
class Program {
  public:
    /// `arguments` are those of the program, with a null pointer at the end.
    Program(CLI::App& app, char** arguments) : app_(app), arguments_(arguments) {}
    CLI::App& app() { return app_; }
    char** arguments() { return arguments_; }
    /// Options of a command, which live as long as the program.
    template <class Options>
    Options& options() {
        const auto made = std::make_shared<Options>();
        options_.push_back(made);
        return *made;
    }
    /// Adds a command. `act` returns the exit status; `footer` ends the help.
    template <class Options>
    Command<Options> add(const std::string& name, const std::string& description, int (*act)(const Options&),
                         const std::string& footer) {
        auto& o = options<Options>();
        auto& command = add(name, description, [act, &o] { return act(o); });
        command.footer(footer);
        return {command, o};
    }
    CLI::App& add(const std::string& name, const std::string& description, std::function<int()> act) {
        auto& command = *app_.add_subcommand(name, description);
        on(command, std::move(act));
        return command;
    }
    void on(const CLI::App& command, std::function<int()> act) { actions_[&command] = std::move(act); }
    /// Executes the command that was parsed.
    int execute() { return actions_.at(app_.get_subcommands().front())(); }

  private:
    CLI::App& app_;
    char** arguments_;
    std::vector<std::shared_ptr<void>> options_;
    std::map<const CLI::App*, std::function<int()>> actions_;
};

// The commands, in the order of the help. Each file adds its own.
void add_run(Program& program);
void add_explain(Program& program);
void add_resume(Program& program);
void add_rerun(Program& program);
void add_experiment(Program& program);
void add_tutorial(Program& program);
void add_plot(Program& program);
void add_convert(Program& program);
void add_edit(Program& program);
void add_new(Program& program);
void add_studio(Program& program);
void add_build_plugin(Program& program);
void add_trust(Program& program);
void add_check(Program& program);
void add_describe(Program& program);
void add_world(Program& program);
void add_view(Program& program);
void add_types(Program& program);
void add_schema(Program& program);
void add_completion(Program& program);
void add_man(Program& program);

}  // namespace forage::tool
