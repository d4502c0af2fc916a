#include <fmt/format.h>

#include <cstdio>

#include "core/engine/simulation.h"
#include "tools/forage/commands.h"

namespace forage::tool {

int check(const Input& input) {
    Diagnostics diagnostics;
    const auto loaded = load(input, diagnostics);
    std::optional<engine::Simulation> simulation;
    if (loaded) simulation = engine::Simulation::build(loaded->system, loaded->registry, {input.seed}, diagnostics);
    fmt::print(stderr, "{}", format(diagnostics));
    if (!simulation) {
        fmt::print(stderr, "{}: {} error{}, {} warning{}\n", input.system, diagnostics.errors(), diagnostics.errors() == 1 ? "" : "s",
                   diagnostics.warnings(), diagnostics.warnings() == 1 ? "" : "s");
        return bad_input;
    }
    std::size_t cells = 0, synapses = 0;
    for (int g = 0; g < simulation->groups(); ++g) cells += static_cast<std::size_t>(simulation->shape(g).cells);
    for (int c = 0; c < simulation->connections(); ++c) synapses += simulation->synapses(c);
    fmt::print("{}: fine: {} processes, {} groups, {} cells, {} connections, {} synapses{}\n", input.system,
               loaded->system.processes.size(), simulation->groups(), cells, simulation->connections(), synapses,
               diagnostics.warnings() ? fmt::format(", {} warnings", diagnostics.warnings()) : "");
    return fine;
}

}  // namespace forage::tool
