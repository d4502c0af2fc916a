#include <cstdio>

#include <fmt/format.h>

#include "core/base/print.h"
#include "core/engine/simulation.h"
#include "core/run/explain.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

std::string counted(std::size_t n, std::string_view one, std::string_view many = "") {
    return fmt::format("{} {}{}", n, n == 1 || many.empty() ? one : many, n == 1 || !many.empty() ? "" : "s");
}

int check(const RunInput& input) {
    Diagnostics diagnostics;
    const auto loaded = load(input, diagnostics);
    const auto simulation = compile(loaded, input.seed, diagnostics);
    print(stderr, "{}", format(diagnostics));
    if (!simulation) {
        print(stderr, "{}: {}, {}\n", printable_line(input.system),
              counted(static_cast<std::size_t>(diagnostics.errors()), "error"),
              counted(static_cast<std::size_t>(diagnostics.warnings()), "warning"));
        return bad_input;
    }
    std::size_t cells = 0, synapses = 0;
    const auto& layout = simulation->layout();
    for (const auto& g : layout.groups) cells += static_cast<std::size_t>(g.shape.cells);
    for (int c = 0; c < std::ssize(layout.connections); ++c) synapses += simulation->synapses(c);
    print("{}: fine: {}, {}, {}, {}, {}{}\n", printable_line(input.system),
          counted(loaded->system.processes.size(), "process", "processes"),
          counted(layout.groups.size(), "group"), counted(cells, "cell"),
          counted(layout.connections.size(), "connection"), counted(synapses, "synapse"),
          diagnostics.warnings() ? ", " + counted(static_cast<std::size_t>(diagnostics.warnings()), "warning")
                                 : "");
    for (const auto& note : wiring_notes(loaded->system, layout)) print("  note: {}\n", note);
    if (loaded->world) print("{}", bug::describe(*loaded->world));
    return fine;
}

}  // namespace

void add_check(Program& program) {
    const auto [command, input] = program.add(
        "check", "Check a system (and a world) and report all mistakes", check,
        "Example:\n  forage check systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world");
    add_input(command, input);
}

}  // namespace forage::tool
