// Systems that do not fit.
#include "tests/support/limited_memory.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Two groups of side x side cells, a short connection and one with a delay.
model::System large(int side, int delay, const std::string& type = "synapseFixedWeight") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", side, side, "neuronRandomSpike"),
               b = model::add_group(s, p, "B", side, side, "neuronNumeric");
    connect(s, a, b, InputKind::excitatory, "synapseFixedWeight", "1").name = "short";
    auto& c = connect(s, a, b, InputKind::excitatory, type, "2");
    c.name = "long";
    c.delay = uniform(delay);
    if (type == "synapseHebbian") c.synapse->feedback.push_back({"postact", "act", {}});
    return s;
}

std::string refusal(const model::System& system) {
    Diagnostics diagnostics;
    const Registry types = registry();
    CHECK_FALSE(engine::Simulation::build(system, types, engine::Demand::everything(), {}, diagnostics));
    CHECK(diagnostics.errors() == 1);
    return format(diagnostics);
}

}  // namespace

TEST_CASE(
    "A system that needs more memory than is allowed is refused before allocation, and its largest part is "
    "named") {
    const std::string wired = refusal(large(300, 100'000));
    CHECK_THAT(wired, ContainsSubstring("the system needs 72.01 GB of memory, the most is 17.18 GB"));
    CHECK_THAT(wired, ContainsSubstring(
                          "the largest part is connection 'long': delay 100000 x 90000 cells = 72 GB"));
    const std::string plastic = refusal(large(200, 30'000, "synapseHebbian"));
    CHECK_THAT(
        plastic,
        ContainsSubstring(
            "the largest part is connection 'long': (4 numbers + delay 30000) x 40000 synapses = 9.602 GB"));
}

TEST_CASE("A system that does not fit into memory is refused with a message") {
    if (!can_limit_memory) {
        WARN("not tested: a sanitizer needs all memory");
        return;
    }
    const auto system = large(300, 1000);  // 0.7 GB
    const LimitedMemory limit(std::size_t{200} << 20);
    const std::string text = refusal(system);
    CHECK_THAT(text, ContainsSubstring("there is not enough memory for the system"));
    CHECK_THAT(text, ContainsSubstring("connection 'long': delay 1000 x 90000 cells = 0.72 GB"));
}
