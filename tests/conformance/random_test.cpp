// Recorded cases that depend on the original's random numbers: the same statistics, not the same values.
#include "core/xml/reader.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_run.h"

using namespace forage;
using namespace forage::test;

namespace {

struct Activity {
    std::size_t cells = 0, active = 0;
    double sum = 0, squares = 0;
    void add(double v) { ++cells, active += v != 0, sum += v, squares += v * v; }
    double rate() const { return static_cast<double>(active) / static_cast<double>(cells); }
    double mean() const { return sum / static_cast<double>(cells); }
    double variance() const { return squares / static_cast<double>(cells) - mean() * mean(); }
};

}  // namespace

TEST_CASE("Cells that fire at random do so as often and as strongly as in the recordings") {
    std::vector<Case> random;  // of random neurons; random connections: topology_test.cpp
    for (const auto& c : cases())
        if (c.name.starts_with("neuron_") && c.name.ends_with("_RANDOM")) random.push_back(c);
    REQUIRE(random.size() >= 3);
    const auto [name, status, note, path] = GENERATE_REF(from_range(random));
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    replay::Replay player;
    if (std::filesystem::exists(path / "drive.csv")) player.file = path / "drive.csv";
    registry.add(module_type(player));
    Diagnostics diagnostics;
    const auto system = xml::read_system(path / "input.iqr", diagnostics);
    REQUIRE(system);
    auto simulation =
        engine::Simulation::build(*system, registry, engine::Demand::everything(), {}, diagnostics);
    REQUIRE(simulation);
    simulation->start();

    std::map<std::string, std::pair<Activity, Activity>> by_group;  // ours, recorded
    for (const auto& row : expected_rows(path / "expected.csv")) {
        if (row.state != "act") continue;
        while (simulation->cycle() <= row.cycle) simulation->step();
        const ConstColumn ours = find_column(*simulation, row);
        REQUIRE(ours.size() == static_cast<Index>(row.values.size()));
        auto& [a, b] = by_group[row.group];
        for (const double v : ours) a.add(v);
        for (const double v : row.values) b.add(v);
    }
    REQUIRE(!by_group.empty());
    for (const auto& [group, activity] : by_group) {
        const auto& [ours, recorded] = activity;
        INFO(name << " " << group << ": active " << ours.rate() << ", recorded " << recorded.rate() << " of "
                  << ours.cells);
        // Two samples of a proportion: four standard errors of their difference.
        const double p = recorded.rate();
        const double error = 4 * std::sqrt(2 * std::max(p * (1 - p), 1e-9) / static_cast<double>(ours.cells));
        CHECK(std::abs(ours.rate() - recorded.rate()) <= error);
        CHECK(std::abs(ours.mean() - recorded.mean()) <=
              4 * std::sqrt(2 * std::max(recorded.variance(), 1e-9) / static_cast<double>(ours.cells)));
    }
}
