// The recorded synapse states of connections that learn or read their target.
#include "core/xml/reader.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_run.h"

using namespace forage;
using namespace forage::test;

namespace {

/// The recorded state of a connection's synapses, or an empty column when Forage keeps none of that name.
ConstColumn find_synapses(const engine::Simulation& s, std::string_view id, std::string_view state) {
    for (int c = 0; c < s.connections(); ++c)
        for (std::size_t i = 0; i < s.synapse_type(c).states.size(); ++i)
            if (s.connection_id(c) == id && s.synapse_type(c).states[i].name == state) return s.synapse_state(c, static_cast<int>(i));
    return {nullptr, 0};
}

}  // namespace

TEST_CASE("Weights and potentials of synapses are those recorded") {
    if (absent(conformance_dir())) return;
    std::size_t compared = 0;
    for (const auto& c : cases()) {
        const auto file = c.path / "expected_synapses.csv";
        if (!std::filesystem::exists(file)) continue;
        INFO(c.name);
        Registry registry;
        add_neurons(registry);
        add_synapses(registry);
        replay::Replay player;
        player.table = std::make_shared<replay::DriveTable>(replay::DriveTable::read(c.path / "drive.csv"));
        registry.add(module_type(player));
        Diagnostics diagnostics;
        const auto system = xml::read_system(c.path / "input.iqr", diagnostics);
        REQUIRE(system);
        auto simulation = engine::Simulation::build(*system, registry, {}, diagnostics);
        REQUIRE(simulation);
        simulation->start();

        Rows rows(file);
        for (std::vector<std::string_view> f; rows.next(f);) {
            ExpectedRow row{number<std::uint64_t>(f[0]), std::string(f[1]), std::string(f[2]), std::string(f[3]), {}};
            for (std::size_t i = 5; i < f.size(); ++i) row.values.push_back(number(f[i]));
            while (simulation->cycle() <= row.cycle) simulation->step();
            const ConstColumn ours = find_synapses(*simulation, row.process, row.state);
            if (ours.size() == 0) continue;
            const std::string problem = difference(ours, row);
            INFO(problem);
            REQUIRE(problem.empty());
            ++compared;
        }
    }
    CHECK(compared > 300);
}
