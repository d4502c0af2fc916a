#include "core/run/weights.h"

#include <cmath>

#include "tests/unit/core/engine/simulations.h"
#include "tools/api/forage/forage.h"

using namespace forage;

namespace {

/// Three cells that drive two, each of them all.
Run driven(const std::string& synapse) {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto a = model::add_group(system, p, "A", 3, 1, "one");
    const auto b = model::add_group(system, p, "B", 2, 1, "neuronNumeric");
    model::add_connection(system, a, b, InputKind::excitatory, synapse);
    auto& c = system.connections.front();
    c.name = "A to B", c.pattern = model::ForeachPattern{};
    if (synapse == "synapseHebbian") c.synapse->feedback.push_back({"postact", "act", {}});
    return open(system, test::registry());
}

}  // namespace

TEST_CASE("Weights of a connection are set in a run, and continue after a checkpoint") {
    const std::string synapse = GENERATE("synapseFixedWeight", "synapseHebbian");
    Run run = driven(synapse), later = driven(synapse), other = driven(synapse);
    const std::vector<double> w{0.25, 0.5, 1, 2, 4, 8};
    const int c = find_connection(run, "A to B");
    set_weights(run, check_weights(run, c, w));
    CHECK(weights(run, c) == w);
    CHECK(weights(other, c) != w);
    run.step();
    Archive kept;
    run.checkpoint(kept);
    later.start();
    Archive restored{std::string_view(kept.bytes())};
    later.checkpoint(restored);
    CHECK(restored.left().empty());
    for (Run* r : {&run, &later}) r->step(), r->step();
    CHECK(run.digest() == later.digest());
    if (synapse == "synapseFixedWeight") CHECK(run.read("P/B") == std::vector<double>{1.75, 14});
    other.start();
    Archive first;
    other.checkpoint(first);
    Archive again{std::string_view(first.bytes())};
    later.checkpoint(again);  // of a run with its own weights
    CHECK(weights(later, c) == weights(other, c));
    CHECK(later.digest() == other.digest());
}

TEST_CASE("Weights that do not fit a connection are errors") {
    Run run = driven("synapseFixedWeight");
    CHECK(is_connection(run, "A to B"));
    CHECK_FALSE(is_connection(run, "P/A"));
    CHECK_THROWS_AS(find_connection(run, "B to A"), InputError);
    CHECK_THROWS_AS(check_weights(run, 0, std::vector<double>(5)), InputError);
    CHECK_THROWS_AS(check_weights(run, 0, std::vector<double>(6, std::nan(""))), InputError);
    Run lean = open(run.system(), test::registry(), nullptr, {.observe = std::vector<std::string>{"P/A"}});
    CHECK_THROWS_AS(check_weights(lean, 0, std::vector<double>(6)), InputError);
}
