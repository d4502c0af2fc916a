// Whole systems with recorded sensory input: the same activity in every group.
#include <algorithm>
#include <random>

#include "core/model/edit.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_run.h"

using namespace forage;
using namespace forage::test;

namespace {

using Path = std::filesystem::path;

Registry types(const Path& drive) {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    add_modules(registry);
    replay::Replay player;
    player.file = drive;
    registry.add(module_type(player));
    auto robot = module_type(player);
    robot.name = "moduleGazeboBug";  // the recording replaces the robot
    registry.add(std::move(robot));
    return registry;
}

/// Rows to compare: not what the phantom says. Sorted by cycle.
std::vector<ExpectedRow> rows_of(const std::vector<Path>& files) {
    std::vector<ExpectedRow> out;
    for (const auto& file : files)
        for (auto& row : expected_rows(file))
            if (!row.group.starts_with("@module:")) out.push_back(std::move(row));
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.cycle < b.cycle; });
    return out;
}

/// Runs a system with some of its parameters set and compares rows from `first` on; returns how many there
/// were.
std::size_t compare(const Path& file, const Path& drive, const std::vector<std::string>& settings,
                    const std::vector<ExpectedRow>& rows, std::uint64_t first = 0) {
    INFO(drive.parent_path());
    const Registry registry = types(drive);
    Diagnostics diagnostics;
    diagnostics.lenient = true;  // the phantom has none of the robot's parameters
    auto system = xml::read_system(file, diagnostics);
    REQUIRE(system);
    for (const auto& setting : settings) model::set(*system, registry, setting, diagnostics);
    const bool general_forms = GENERATE(false, true);
    auto simulation = engine::Simulation::build(*system, registry, engine::Demand::everything(),
                                                {.general_forms = general_forms}, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(simulation);
    simulation->start();
    std::size_t compared = 0;
    for (const auto& row : rows) {
        if (row.cycle < first) continue;
        while (simulation->cycle() <= row.cycle) simulation->step();
        const std::string problem = difference(find_column(*simulation, row), row);
        INFO(problem);
        REQUIRE(problem.empty());
        ++compared;
    }
    return compared;
}

/// The adaptive layer of a process reads this file, in the first cycle.
std::vector<std::string> weights_from(const std::string& process, const Path& file) {
    return {process + ".File Name=" + file.string(), process + ".read=true"};
}

}  // namespace

TEST_CASE("The reactive system of the tutorial, driven by recorded input, gives the recorded numbers") {
    const auto recorded = shared_dir() / "golden" / "systems" / "DACReactiveBug";
    const auto file = shared_dir() / "original" / "DAC_files" / "DACReactiveBug.iqr";
    if (absent(recorded) || absent(file)) return;
    CHECK(compare(file, recorded / "drive.csv", {}, rows_of({recorded / "expected.csv"})) > 1000);
}

TEST_CASE("The adaptive system of the tutorial, driven by recorded input, gives the recorded numbers") {
    const auto recorded = shared_dir() / "golden" / "systems" / "DACBugBasicArena";
    const auto file = shared_dir() / "original" / "DAC_files" / "DACBugBasicArena.iqr";
    if (absent(recorded) || absent(file)) return;
    CHECK(compare(file, recorded / "drive.csv", weights_from("Adaptive", recorded / "weights.csv"),
                  rows_of({recorded / "expected.csv"})) > 1000);
}

TEST_CASE("The adaptive system learns as in the recording") {
    const auto recorded = shared_dir() / "golden" / "systems" / "DACBugBasicArena_learning";
    const auto file = shared_dir() / "original" / "DAC_files" / "DACBugBasicArena.iqr";
    if (absent(recorded) || absent(file)) return;
    CHECK(compare(file, recorded / "drive.csv", weights_from("Adaptive", recorded / "weights.csv"),
                  rows_of({recorded / "expected.csv", recorded / "expected_weights_display.csv"})) > 1000);
}

TEST_CASE("An adaptive layer in a small system gives the recorded numbers") {
    const auto all = traces_dir() / "modules" / "in_engine";
    for (const std::string name : {"moduleAL_default", "moduleAL_behavioural_only"}) {
        const auto recorded = all / name;
        // In cycle 1 the display shows weights that were drawn at random; those of the file come after.
        CHECK(compare(recorded / "input.iqr", recorded / "drive.csv",
                      weights_from("AL", recorded / "weights.csv"), rows_of({recorded / "expected.csv"}),
                      2) > 100);
    }
}

TEST_CASE(
    "An adaptive layer that begins with the weights that the original drew gives the recorded numbers") {
    const auto recorded = traces_dir() / "conformance" / "native_moduleAL_RANDOM";
    const auto rows = rows_of({recorded / "expected.csv"});
    // The original's first picture of its weights: 3 blocks, one per response, of 2 x 4 stimulus cells.
    const auto picture = std::find_if(
        rows.begin(), rows.end(), [](const ExpectedRow& r) { return r.cycle == 1 && r.values.size() == 24; });
    REQUIRE(picture != rows.end());
    std::string weights;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 8; ++i)
            weights += fmt::format("{:.17g}, ", picture->values[i / 2 * 6 + k * 2 + i % 2]);
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("forage_weights_{}.txt", std::random_device{}());
    std::ofstream(file) << weights;
    CHECK(compare(recorded / "input.iqr", recorded / "drive.csv", weights_from("AL", file), rows, 2) > 100);
    std::filesystem::remove(file);
}
