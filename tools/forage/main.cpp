// forage: run and check iqr systems from the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "tools/forage/commands.h"

namespace {

using namespace forage::tool;

void add_input(CLI::App& command, Input& input) {
    command.add_option("SYSTEM", input.system, "System file (.iqr)")->required();
    command.add_option("-w,--world", input.world, "World in which the robot lives (.world)");
    command.add_option("-s,--set", input.settings,
                       "Change a parameter: 'Process/Group.parameter=value', 'Process.parameter=value' for a module, "
                       "'Connection.parameter=value' for a synapse; may be repeated")
        ->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_flag("--lenient", input.lenient, "Unknown parameters and attributes are warnings, not errors");
}

void add_run(CLI::App& app, RunOptions& o) {
    auto& run = *app.add_subcommand("run", "Run a system, in a world if one is given");
    run.footer(
        "Without --cycles, --seconds or --trials it runs for 60 seconds of the world.\n"
        "Example:\n"
        "  forage run systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world --trials 30");
    add_input(run, o.input);
    auto* cycles = run.add_option("-c,--cycles", o.cycles, "Stop after so many cycles");
    auto* seconds = run.add_option("--seconds", o.seconds, "Stop after so many seconds of the world");
    auto* trials = run.add_option("-t,--trials", o.trials, "Stop after so many trials; a trial ends when the robot is reset");
    cycles->excludes(seconds)->excludes(trials)->check(CLI::PositiveNumber);
    seconds->excludes(trials)->check(CLI::PositiveNumber);
    trials->check(CLI::PositiveNumber);
    run.add_option("--longest-trial", o.longest_trial, "Give up with --trials when one takes longer, in seconds of the world")
        ->capture_default_str()->check(CLI::PositiveNumber);
    run.add_option("--seed", o.input.seed, "Decides everything random")->capture_default_str();
    run.add_option("-r,--record", o.recordings,
                   "Write 'Process/Group' (its activity) or 'Process/Group:state' to a CSV file; may be repeated")
        ->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    run.add_option("--every", o.every, "Record every K-th cycle")->capture_default_str()->check(CLI::PositiveNumber);
    run.add_option("--drive", o.input.drive, "Table that modules of type moduleReplay play: cycle,process,target,v0,v1,...");
    run.add_option("--clamp", o.input.clamp, "Table of activities to overwrite: cycle,process,group,v0,v1,...");
    run.add_option("-o,--output", o.directory, "Directory for results; '' for none")->capture_default_str();
    run.add_option("--world-pace", o.input.world_pace, "Seconds of the world per second of the clock, instead of the world's own");
    run.add_flag("!--no-noise", o.input.noise, "Robots and sensors without noise");
    run.add_flag("--realtime", o.real_time, "No faster than the clock: one second of the world per second");
    run.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

void add_convert(CLI::App& app, ConvertOptions& o) {
    auto& convert = *app.add_subcommand("convert", "Read a system or process file and write it in the standard layout");
    convert.add_option("IN", o.input, "File to read (.iqr or .iqrProcess)")->required();
    convert.add_option("OUT", o.output, "File to write (.iqr or .iqrProcess); may be the same")->required();
    convert.add_option("--import", o.imports, "Add a copy of a process from an .iqrProcess file; may be repeated")
        ->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    convert.add_option("--extract", o.extract, "Write this process alone, with the connections among its groups");
    convert.add_flag("--embed", o.embed, "Write the content of linked processes instead of the links");
    convert.add_flag("--lenient", o.lenient, "Unknown parameters and attributes are warnings, and left out");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Runs iqr brain models headless, in a closed loop with a simulated robot.", "forage");
    app.set_version_flag("--version", "forage " FORAGE_VERSION);
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::simple);

    RunOptions run_options;
    ConvertOptions convert_options;
    Input check_input;
    std::string type;
    add_run(app, run_options);
    add_convert(app, convert_options);
    auto& check_command = *app.add_subcommand("check", "Check a system (and world) and say everything that is wrong with it");
    add_input(check_command, check_input);
    auto& types_command = *app.add_subcommand("types", "List the neuron, synapse and module types, or describe one");
    types_command.add_option("NAME", type, "The type to describe");

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        fmt::print(stderr, "error: {}\n  hint: 'forage {}--help' lists what there is\n", e.what(),
                   app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name() + " ");
        return bad_input;
    }
    try {
        if (app.got_subcommand("run")) return run(run_options);
        if (app.got_subcommand("check")) return check(check_input);
        if (app.got_subcommand("convert")) return convert(convert_options);
        return types(type);
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return run_failed;
    }
}
