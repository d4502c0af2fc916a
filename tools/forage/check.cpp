#include <algorithm>
#include <cctype>
#include <cstdio>

#include <fmt/format.h>

#include "core/engine/simulation.h"
#include "core/run/explain.h"
#include "tools/forage/commands.h"

namespace forage::tool {
namespace {

std::string counted(std::size_t n, std::string_view one, std::string_view many = "") {
    return fmt::format("{} {}{}", n, n == 1 || many.empty() ? one : many, n == 1 || !many.empty() ? "" : "s");
}

}  // namespace

int check(const RunInput& input) {
    Diagnostics diagnostics;
    const auto loaded = load(input, diagnostics);
    const auto simulation = compile(loaded, input.seed, diagnostics);
    fmt::print(stderr, "{}", format(diagnostics));
    if (!simulation) {
        std::string name =
            input.system;  // it may contain control characters, which must not reach the terminal
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
        fmt::print(stderr, "{}: {}, {}\n", name,
                   counted(static_cast<std::size_t>(diagnostics.errors()), "error"),
                   counted(static_cast<std::size_t>(diagnostics.warnings()), "warning"));
        return bad_input;
    }
    std::size_t cells = 0, synapses = 0;
    const auto& layout = simulation->layout();
    for (const auto& g : layout.groups) cells += static_cast<std::size_t>(g.shape.cells);
    for (int c = 0; c < std::ssize(layout.connections); ++c) synapses += simulation->synapses(c);
    fmt::print("{}: fine: {}, {}, {}, {}, {}{}\n", input.system,
               counted(loaded->system.processes.size(), "process", "processes"),
               counted(layout.groups.size(), "group"), counted(cells, "cell"),
               counted(layout.connections.size(), "connection"), counted(synapses, "synapse"),
               diagnostics.warnings()
                   ? ", " + counted(static_cast<std::size_t>(diagnostics.warnings()), "warning")
                   : "");
    for (const auto& note : wiring_notes(loaded->system, layout)) fmt::print("  note: {}\n", note);
    if (loaded->world) fmt::print("{}", bug::describe(*loaded->world));
    return fine;
}

}  // namespace forage::tool
