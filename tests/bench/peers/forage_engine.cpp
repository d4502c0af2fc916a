// A system file in Forage's engine: answers each line of its input, a number of seconds, with cycles per
// second of processor time. All groups are updated, as in a run that records all activities.
//
//     peer_forage_engine SYSTEM
#include <iostream>
#include <string>

#include "core/engine/simulation.h"
#include "core/xml/reader.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/report.h"

int main(int argc, char** argv) {
    using namespace forage;
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    const auto system = argc == 2 ? xml::read_system(argv[1], diagnostics) : std::nullopt;
    auto layout = system ? engine::make_layout(*system, registry, diagnostics) : std::nullopt;
    if (!layout) {
        std::cerr << "peer_forage_engine SYSTEM\n" << format(diagnostics);
        return 2;
    }
    engine::Demand demand;
    for (int g = 0; g < std::ssize(layout->groups); ++g) demand.read_group(g);
    auto simulation = engine::Simulation::build(*system, std::move(*layout), demand, {}, diagnostics);
    if (!simulation) return 2;
    simulation->start();
    for (std::string line; std::getline(std::cin, line);) {
        bench::Rates rates;
        bench::add_rates(
            rates, bench::thread_seconds, 1, [&] { simulation->step(); }, std::stod(line));
        std::cout << rates.best() << std::endl;
    }
}
