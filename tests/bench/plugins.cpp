// Is a type as fast in a plugin as among those that ship? Runs a group of each in turns, and prints the
// ratio of their times.
#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include <fmt/format.h>

#include "core/engine/simulation.h"
#include "core/model/build.h"
#include "core/plugin/plugin.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/report.h"

using namespace forage;

namespace {

/// A system of random spikes that excite `cells` cells of a type, one to one.
model::System system_of(const std::string& neuron, int cells) {
    model::System system;
    const auto process = model::add_process(system, "P");
    const auto in = model::add_group(system, process, "In", cells, 1, "neuronRandomSpike");
    const auto out = model::add_group(system, process, "Out", cells, 1, neuron);
    model::set_parameter(model::find_group(system, in)->neuron, "probability", "0.01");
    model::set_parameter(model::find_group(system, out)->neuron, "vmPrs", "0.9");
    model::add_connection(system, in, out, InputKind::excitatory, "synapseFixedWeight");
    return system;
}

double nanoseconds(engine::Simulation& simulation, int cycles) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < cycles; ++i) simulation.update_groups();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() /
           cycles;
}

}  // namespace

int main() {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    plugin::add(plugin::load({{FORAGE_TWINS}}, plugin::Use::run, registry, diagnostics), registry);
    for (const int cells : {10, 1000, 100'000}) {
        std::vector<engine::Simulation> simulations;
        for (const char* type : {"neuronLinearThreshold", "neuronLinearThresholdTwin"}) {
            auto one = engine::Simulation::build(system_of(type, cells), registry,
                                                 engine::Demand::everything(), {}, diagnostics);
            if (!one) return fmt::print("{}", format(diagnostics)), 1;
            one->start();
            simulations.push_back(std::move(*one));
        }
        const int cycles = std::max(10, 2'000'000 / (cells + 1000));
        std::array<std::vector<double>, 2> times;
        for (int round = 0; round < 51; ++round)
            for (std::size_t i = 0; i < 2; ++i) {
                const std::size_t which = (i + static_cast<std::size_t>(round)) % 2;
                simulations[which].step();
                times[which].push_back(nanoseconds(simulations[which], cycles));
            }
        const double shipped = bench::median(times[0]), twin = bench::median(times[1]);
        fmt::print("{:7} cells  shipped {:10.1f} ns  plugin {:10.1f} ns  ratio {:.3f}\n", cells, shipped,
                   twin, twin / shipped);
        bench::result(fmt::format("plugin/{} cells", cells), "time / of the type that ships", twin / shipped,
                      "");
    }
    return 0;
}
