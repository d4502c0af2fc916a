// Compares every recorded case of the original: the numbers in every state of every group and cycle.
#include <iostream>

#include "core/xml/reader.h"
#include "modules/modules.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/echo.h"
#include "tests/support/recorded_run.h"

namespace {

using namespace forage;
using namespace forage::test;

Registry registry_for(const Case& c) {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    replay::Replay player;
    if (std::filesystem::exists(c.path / "drive.csv")) player.file = c.path / "drive.csv";
    registry.add(module_type(player));
    registry.add(module_type<Echo>());
    add_modules(registry);
    return registry;
}

/// Overwrites activities with the rows of a clamp.csv, each from its cycle on.
class Clamp {
  public:
    explicit Clamp(const Case& c) {
        if (std::filesystem::exists(c.path / "clamp.csv")) table_ = DriveTable::read(c.path / "clamp.csv");
    }
    void apply(engine::Simulation& s) {
        for (; next_ < table_.rows().size() &&
               table_.rows()[next_].cycle <= static_cast<std::int64_t>(s.cycle());
             ++next_) {
            const auto& row = table_.rows()[next_];
            for (int g = 0; g < std::ssize(s.layout().groups); ++g)
                if (s.layout().groups[g].path == row.process + "/" + row.target) held_[g] = &row;
        }
        for (const auto& [group, row] : held_)
            s.output(group) = ConstColumn(row->values.data(), static_cast<Index>(row->values.size()));
    }

  private:
    DriveTable table_;
    std::size_t next_ = 0;
    std::map<int, const DriveTable::Row*> held_;
};

/// The first difference from the recording, or the mistake in the case; empty when there is none.
std::string run(const Case& c, bool general_forms) {
    Diagnostics diagnostics;
    const auto system = xml::read_system(c.path / "input.iqr", diagnostics);
    const Registry registry = registry_for(c);
    auto simulation = system ? engine::Simulation::build(*system, registry, engine::Demand::everything(),
                                                         {.general_forms = general_forms}, diagnostics)
                             : std::nullopt;
    if (c.status == "refused" && format(diagnostics).find("has no synapses") == std::string::npos)
        return "not refused for want of synapses";
    if (c.status != "ok") return simulation || !diagnostics.failed() ? "not refused" : "";
    if (!simulation) return format(diagnostics);
    if (c.name.ends_with("_RANDOM")) return {};  // its statistics: random_test.cpp

    Clamp clamp(c);
    simulation->start();
    for (const auto& row : expected_rows(c.path / "expected.csv")) {
        while (simulation->cycle() <= row.cycle) {
            simulation->update_groups();
            clamp.apply(*simulation);
            simulation->update_modules();
            simulation->update_connections();
        }
        const bool of_disabled_module =
            row.group.starts_with("@module:") && find_column(*simulation, row).size() == 0;
        if (of_disabled_module &&
            std::all_of(row.values.begin(), row.values.end(), [](double v) { return v == 0; }))
            continue;
        const auto problem = difference(find_column(*simulation, row), row);
        if (!problem.empty()) return problem;
    }
    return {};
}

}  // namespace

TEST_CASE("Every recorded case gives the recorded numbers") {
    const bool general_forms = GENERATE(false, true);
    int met = 0;
    for (const auto& c : cases()) {
        INFO(c.name);
        const std::string problem = run(c, general_forms);
        CHECK(problem == "");
        met += problem.empty();
    }
    std::cout << "cases met: " << met << "\n";
    CHECK(met > 200);
}
