// Whole tutorial systems with recorded sensory input: the same activity in every group.
#include "core/xml/reader.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_run.h"

using namespace forage;
using namespace forage::test;

TEST_CASE("The reactive system of the tutorial, driven by recorded input, gives the recorded numbers") {
    const auto recorded = shared_dir() / "golden" / "systems" / "DACReactiveBug";
    const auto file = shared_dir() / "original" / "DAC_files" / "DACReactiveBug.iqr";
    if (absent(recorded) || absent(file)) return;

    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    replay::Replay player;
    player.table = std::make_shared<replay::DriveTable>(replay::DriveTable::read(recorded / "drive.csv"));
    auto robot = module_type(player);
    robot.name = "moduleGazeboBug";  // the recording stands in for the robot
    registry.add(std::move(robot));

    Diagnostics diagnostics;
    diagnostics.lenient = true;  // the stand-in has none of the robot's parameters
    const auto system = xml::read_system(file, diagnostics);
    REQUIRE(system);
    const bool general_forms = GENERATE(false, true);
    auto simulation = engine::Simulation::build(*system, registry, {.general_forms = general_forms}, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(simulation);
    simulation->start();
    std::size_t compared = 0;
    for (const auto& row : expected_rows(recorded / "expected.csv")) {
        if (row.group.starts_with("@module:")) continue;  // the stand-in's own words
        while (simulation->cycle() <= row.cycle) simulation->step();
        const std::string problem = difference(find_column(*simulation, row), row);
        INFO(problem);
        REQUIRE(problem.empty());
        ++compared;
    }
    CHECK(compared > 1000);
}
