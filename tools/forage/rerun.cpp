// Repeats a run or an experiment.
#include "core/run/rerun.h"

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/print.h"
#include "core/base/separated.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct RerunOptions {
    std::string path;                        ///< a bundle, a run.json or a directory of results
    std::string directory = "forage-rerun";  ///< where it is unpacked and run
    bool quiet = false;
};

namespace fs = std::filesystem;

/// Runs the command of `rerun`; others than those that Forage notes in results are errors. Returns the exit
/// status.
int execute(const Rerun& rerun, bool quiet, Diagnostics& diagnostics) {
    if (rerun.command.size() > 1 && rerun.command[0] == "experiment") {
        ExperimentOptions o;
        o.file = rerun.command[1], o.directory = rerun.results, o.quiet = quiet, o.fresh = true;
        for (std::size_t i = 2; i + 1 < rerun.command.size(); i += 2)
            (rerun.command[i] == "--plugin" ? o.plugins : o.formats).push_back(rerun.command[i + 1]);
        if (command_of(o) == rerun.command && check_trusted(o.plugins, diagnostics)) return experiment(o);
    } else if (!rerun.command.empty() && rerun.command[0] == "run") {
        RunOptions o = parse_run(rerun.command);
        o.spec.arguments = rerun.command;
        o.spec.directory = rerun.results, o.quiet = quiet;
        if (o.spec.command == rerun.command && check_trusted(o.spec.input.plugins, diagnostics))
            return run(o);
    }
    if (!diagnostics.failed())
        diagnostics.error(
            {},
            fmt::format("Forage does not note such a command: 'forage {}'", separated(rerun.command, " ")),
            "the file was changed; run the command yourself if you trust it");
    return bad_input;
}

int rerun(const RerunOptions& o) {
    Diagnostics diagnostics;
    auto found = open_rerun(o.path, fs::absolute(o.directory).string(), diagnostics);
    print(stderr, "{}", format(diagnostics));
    if (!found) return bad_input;
    found->expected = fs::absolute(found->expected).string();
    if (!o.quiet)
        for (const auto& note : found->notes) print(stderr, "note: {}\n", note);
    if (!found->start.empty()) fs::current_path(found->start);
    Diagnostics refused;
    const int status = execute(*found, o.quiet, refused);
    print(stderr, "{}", format(refused));
    if (status != fine) return status;
    const auto all = differences(*found);
    for (const auto& d : all) print("{}: {}\n", d.file, d.what);
    if (all.empty()) {
        if (!o.quiet) print("  repeated: {} files of results, all as before\n", found->files.size());
        return fine;
    }
    const std::string versions = version_difference(*found);
    print(stderr, "error: {} of {} files of results differ from those of before\n  hint: {}\n", all.size(),
          found->files.size(),
          versions.empty() ? fmt::format("compare them: {} and {}", found->expected, found->results)
                           : versions);
    return run_failed;
}

}  // namespace

void add_rerun(Program& program) {
    const auto [command, o] = program.add(
        "rerun", "Repeat a run or an experiment, and compare the results with those of before", rerun,
        "Of a bundle, inputs/ has the files, expected/ the results of before, results/ those of now.\n"
        "'forage run --bundle paper.zip' writes a bundle.\n"
        "Example:\n"
        "  forage rerun paper.zip");
    add_value(command, "FILE", o.path, "FILE|DIR",
              "Bundle, or the run.json or the directory of results of a run whose files are in place")
        ->required();
    add_value(command, "-o,--output", o.directory, "DIR", "Directory for files and results [forage-rerun]")
        ->check(named("directory"));
    command.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

}  // namespace forage::tool
