#include "core/model/build.h"

#include <stdexcept>

#include "core/model/refused.h"
#include "core/model/validate.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"

using namespace forage;
using namespace forage::model;

namespace {

System small() {
    System s;
    const auto p = add_process(s, "P");
    const auto a = add_group(s, p, "A", 3, 2, "neuronRandomSpike"),
               b = add_group(s, p, "B", 3, 2, "neuronLinearThreshold");
    add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight");
    auto& m = find_process(s, p)->module.emplace();
    m.type = "someModule";
    m.outputs.push_back({"out", a, {}});
    return s;
}

}  // namespace

TEST_CASE("A system that is built in code passes the checks") {
    System s = small();
    s.processes[0].module.reset();
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    validate(s, registry, diagnostics);
    INFO(format(diagnostics));
    CHECK(diagnostics.all().empty());
}

TEST_CASE("New ids are unique, and ids that are taken are refused") {
    System s = small();
    const auto p = s.processes[0].id;
    const auto c = add_group(s, p, "C", 1, 1, "neuronNumeric");
    CHECK(c != s.processes[0].groups[0].id);
    CHECK(c != s.processes[0].groups[1].id);
    CHECK_THROWS_AS(add_group(s, p, "D", 1, 1, "neuronNumeric", c), std::invalid_argument);
    CHECK_THROWS_AS(add_group(s, "nowhere", "D", 1, 1, "neuronNumeric"), std::invalid_argument);
    CHECK_THROWS_AS(add_connection(s, c, "nowhere", InputKind::excitatory, "synapseFixedWeight"),
                    std::invalid_argument);
}

TEST_CASE("Removing a group removes its connections and unsets references to it") {
    System s = small();
    remove(s, s.processes[0].groups[0].id);
    CHECK(s.processes[0].groups.size() == 1);
    CHECK(s.connections.empty());
    CHECK(s.processes[0].module->outputs[0].target.empty());
    CHECK_THROWS_AS(remove(s, "nowhere"), std::invalid_argument);
}

TEST_CASE("Removing a process removes its groups and their connections") {
    System s = small();
    const auto q = add_process(s, "Q");
    const auto c = add_group(s, q, "C", 3, 2, "neuronLinearThreshold");
    add_connection(s, s.processes[0].groups[1].id, c, InputKind::excitatory, "synapseFixedWeight");
    remove(s, s.processes[0].id);
    REQUIRE(s.processes.size() == 1);
    CHECK(s.processes[0].id == q);
    CHECK(s.connections.empty());
}

TEST_CASE("An empty name is refused, with a hint, and the item keeps its name") {
    System s = small();
    const System before = s;
    for (const auto& id : {s.processes[0].id, s.processes[0].groups[0].id, s.connections[0].id})
        for (const char* name : {"", " \t"}) CHECK_THROWS_AS(rename(s, id, name), Refused);
    CHECK(s == before);
}

TEST_CASE("What a linked process holds is not renamed") {
    System s = small();
    auto& p = s.processes[0];
    p.path = "part.iqrProcess", p.placeholder = {Process()}, s.connections[0].linked = true;
    for (const auto& id : {p.id, p.groups[0].id, s.connections[0].id})
        CHECK_THROWS_AS(rename(s, id, "New"), std::invalid_argument);
}

TEST_CASE("Editing a copy does not change the original") {
    const System original = small();
    System copy = original;
    rename(copy, copy.processes[0].groups[0].id, "Renamed");
    set_parameter(copy.processes[0].groups[1].neuron, "threshold", "0.5");
    set_parameter(copy.processes[0].groups[1].neuron, "threshold", "0.6");
    remove(copy, copy.connections[0].id);
    CHECK(original.processes[0].groups[0].name == "A");
    CHECK(original.processes[0].groups[1].neuron.settings.empty());
    CHECK(original.connections.size() == 1);
    CHECK(copy.processes[0].groups[0].name == "Renamed");
    REQUIRE(copy.processes[0].groups[1].neuron.settings.size() == 1);
    CHECK(copy.processes[0].groups[1].neuron.settings[0].value == "0.6");
}
