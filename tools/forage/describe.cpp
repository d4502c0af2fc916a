#include <cstdio>

#include "core/base/print.h"
#include "tools/api/describe/system_description.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct DescribeOptions {
    RunInput input;
    std::string format = "text";  ///< text, markdown, latex, dot or json
};

int describe(const DescribeOptions& options) {
    Diagnostics diagnostics;
    const auto loaded = load(options.input, diagnostics);
    const auto compiled = compile(loaded, options.input.seed, diagnostics);
    print(stderr, "{}", format(diagnostics));
    if (!compiled) return bad_input;
    print("{}", in_format(forage::describe(loaded->system, loaded->registry, &*compiled), options.format));
    return fine;
}

}  // namespace

void add_describe(Program& program) {
    const auto [command, o] = program.add(
        "describe", "Show the processes, groups and connections of a system, with sizes", describe,
        "Example:\n"
        "  forage describe systems/reactive_foraging.iqr\n"
        "  forage describe systems/reactive_foraging.iqr --format latex > reactive_foraging.tex");
    add_input(command, o.input);
    add_value(command, "--format", o.format, "FORMAT",
              "text; for papers: markdown or latex (tables), dot (a graph for Graphviz); for programs: "
              "json [text]")
        ->check(one_of({"text", "markdown", "latex", "dot", "json"}));
    for (const char* format : {"markdown", "latex", "dot", "json"})
        command.add_flag_callback(
            std::string("--") + format, [&o = o, format] { o.format = format; },
            std::string("The same as --format ") + format);
}

}  // namespace forage::tool
