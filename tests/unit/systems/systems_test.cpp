// Every system that ships, and every system of the original, is read without a mistake.
#include <algorithm>
#include <filesystem>

#include "core/connectivity/connect.h"
#include "core/equations/declared_types.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/xml/reader.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> systems_below(const fs::path& folder) {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".iqr") out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

/// Reads and checks a system, and builds its connections. Only modules may be unknown, because this test does
/// not include their rooms. A system of the original has two groups of one name.
void check_system(const fs::path& file) {
    INFO(file.string());
    Diagnostics diagnostics;
    const auto system = xml::read_system(file.string(), diagnostics);
    INFO(format(diagnostics));
    REQUIRE(system);
    CHECK(diagnostics.all().empty());
    CHECK_FALSE(system->processes.empty());

    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics checked;
    equations::add_types(*system, registry, checked);
    model::validate(*system, registry, checked);
    for (const auto& d : checked.all()) {
        INFO(format(d));
        CHECK((d.message.starts_with("there is no module type") ||
               d.message == "there is already a group 'Selection/Approach'"));
    }
    const model::GroupIndex groups(*system);
    for (const auto& c : system->connections) {
        REQUIRE((groups.find(c.source).group && groups.find(c.target).group));
        Diagnostics built;
        const auto synapses = connectivity::connect(c, groups.find(c.source).group->topology,
                                                    groups.find(c.target).group->topology, 1, built);
        INFO(format(built));
        CHECK(built.all().empty());
        CHECK(synapses.size() > 0);
    }
}

}  // namespace

TEST_CASE("Every system that ships is read without a diagnostic, and all its connections have synapses") {
    const auto files = systems_below(test::source_dir() / "systems");
    REQUIRE(files.size() >= 2);
    for (const auto& file : files) check_system(file);
}

TEST_CASE(
    "Every system of the original is read without a diagnostic, and all its connections have synapses") {
    if (test::absent(test::shared_dir() / "original")) return;
    const auto files = systems_below(test::shared_dir() / "original");
    REQUIRE(files.size() >= 4);
    for (const auto& file : files) check_system(file);
}
