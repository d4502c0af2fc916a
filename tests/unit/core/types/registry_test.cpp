#include "core/types/registry.h"

#include <stdexcept>

#include "tests/support/catch.h"

using namespace forage;

namespace {

struct Cell {
    double gain = 2;
    int count = 3;
    bool clip = true;
    std::string mode = "fast";
    static void describe(NeuronSpec<Cell>& s) {
        s.name("cell", "Cell").doc("For tests.").reads(InputKind::excitatory, InputKind::modulatory);
        s.param("gain", &Cell::gain).label("Gain").unit("mV").range(0, 10).doc("How much.");
        s.param("count", &Cell::count);
        s.param("clip", &Cell::clip);
        s.param("mode", &Cell::mode);
        s.state("vm", "Potential", 2).output("act", "Activity");
    }
    void update(NeuronColumns&) const {}
};

NeuronType neuron(const std::string& name, int outputs, int parameters = 0) {
    NeuronType type;
    type.name = name;
    for (int i = 0; i < outputs; ++i) type.states.push_back({"act" + std::to_string(i), "", 1, true});
    type.parameters.resize(static_cast<std::size_t>(parameters));  // all of the same, empty name
    return type;
}

}  // namespace

TEST_CASE("A type has what its declaration lists, with the members' initializers as defaults") {
    Registry registry;
    registry.add(neuron_type<Cell>());
    const NeuronType* type = registry.neuron("cell");
    REQUIRE(type);
    CHECK(type->label == "Cell");
    REQUIRE(type->parameters.size() == 4);
    const Parameter& gain = type->parameters[0];
    CHECK((gain.name == "gain" && gain.label == "Gain" && gain.unit == "mV" && gain.doc == "How much."));
    CHECK(gain.default_value == ParameterValue(2.0));
    REQUIRE(gain.range);
    CHECK((gain.range->low == 0 && gain.range->high == 10));
    CHECK(type->parameters[1].kind == ParameterKind::integer);
    CHECK(type->parameters[1].label == "count");  // its name, when nothing else is said
    CHECK(type->parameters[2].default_value == ParameterValue(true));
    CHECK(type->parameters[3].default_value == ParameterValue(std::string("fast")));
    CHECK(type->output() == 1);
    CHECK(type->states[0].history == 2);
    CHECK((type->reads[0] && !type->reads[1] && type->reads[2]));
}

TEST_CASE("A parameter is set and read in one object of its type and in no other") {
    const NeuronType type = neuron_type<Cell>();
    const auto one = type.make(), other = type.make();
    type.parameters[0].set(one->parameters(), 7.5);
    type.parameters[3].set(one->parameters(), std::string("slow"));
    CHECK(type.parameters[0].get(one->parameters()) == ParameterValue(7.5));
    CHECK(type.parameters[3].get(one->parameters()) == ParameterValue(std::string("slow")));
    CHECK(type.parameters[0].get(other->parameters()) == ParameterValue(2.0));
}

TEST_CASE("A registry refuses types with inconsistent declarations") {
    Registry registry;
    registry.add(neuron("a", 1));
    CHECK_THROWS_WITH(registry.add(neuron("a", 1)), "there is already a neuron type 'a'");
    CHECK_THROWS_WITH(registry.add(neuron("", 1)), "a neuron type without a name");
    CHECK_THROWS_WITH(registry.add(neuron("b", 0)),
                      "neuron type 'b' declares 0 output states, it must have exactly one");
    CHECK_THROWS_WITH(registry.add(neuron("b", 2)),
                      "neuron type 'b' declares 2 output states, it must have exactly one");
    CHECK_THROWS_WITH(registry.add(neuron("b", 1, 2)), "neuron type 'b' declares the parameter '' twice");
    NeuronType twice = neuron("b", 1);
    twice.states.push_back({"act0", "", 1});
    CHECK_THROWS_WITH(registry.add(twice), "neuron type 'b' declares the state 'act0' twice");
    SynapseType synapse;
    synapse.name = "s";
    CHECK_THROWS_AS(registry.add(synapse), std::invalid_argument);
    synapse.states = {{"psp", "", true}, {"psp", ""}};
    CHECK_THROWS_WITH(registry.add(synapse), "synapse type 's' declares the state 'psp' twice");
    synapse.states.pop_back();
    synapse.feedback = {{"back", ""}, {"back", ""}};
    CHECK_THROWS_WITH(registry.add(synapse), "synapse type 's' declares the feedback 'back' twice");
    ModuleType module;
    module.name = "m";
    for (const bool is_output : {false, true, true}) {
        module.ports.emplace_back().name = "a";
        module.ports.back().is_output = is_output;
    }
    CHECK_THROWS_WITH(registry.add(module), "module type 'm' declares the output 'a' twice");
    module.ports.pop_back();  // an input and an output may share a name
    CHECK_NOTHROW(registry.add(module));
    CHECK_THROWS_AS(registry.add(ModuleType{}), std::invalid_argument);
    CHECK(registry.neurons().size() == 1);
    CHECK(registry.synapses().empty());
    CHECK(registry.neuron("b") == nullptr);
}

TEST_CASE("The same name may stand for a neuron, a synapse and a module") {
    Registry registry;
    registry.add(neuron("x", 1));
    SynapseType synapse;
    synapse.name = "x";
    synapse.states.push_back({"psp", "", true});
    registry.add(synapse);
    ModuleType module;
    module.name = "x";
    registry.add(module);
    CHECK((registry.neuron("x") && registry.synapse("x") && registry.module("x")));
    CHECK(names(registry.modules()) == std::vector<std::string>{"x"});
}
