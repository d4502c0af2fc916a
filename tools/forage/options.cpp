#include "tools/forage/options.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/print.h"
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

int refused(const std::string& what, const std::string& hint) {
    print(stderr, "error: {}\n  hint: {}\n", what, hint);
    return bad_input;
}

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

CLI::Option* add_each(CLI::App& command, const char* name, std::function<void(const std::string&)> take,
                      const char* value, const char* description) {
    const auto take_all = [take = std::move(take)](const std::vector<std::string>& texts) {
        std::ranges::for_each(texts, take);
    };
    return repeated(command.add_option_function<std::vector<std::string>>(name, take_all, description))
        ->option_text(value);
}

CLI::Option* add_texts(CLI::App& command, const char* name, std::vector<model::Expression>& list,
                       const char* description, const char* value) {
    const auto add = [&list](const std::string& text) { list.push_back({text}); };
    return add_each(command, name, add, value, description);
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

CLI::App& declare_studio(CLI::App& app, StudioCommand& o) {
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
    return command;
}

}  // namespace forage::tool
