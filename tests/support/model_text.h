// Small systems for tests, as text and as model.
#pragma once

#include <string>

#include "core/model/system.h"
#include "core/types/registry.h"
#include "core/xml/reader.h"
#include "neurons/linear_threshold.h"
#include "neurons/random_spike.h"
#include "synapses/fixed_weight.h"
#include "tests/support/catch.h"

namespace forage::test {

/// A system of two groups of 3 x 2 cells and a connection, with every element and attribute that is often
/// used.
inline const std::string small_system = R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE System PUBLIC '-//INI/iqr421' 'iqrSystem.dtd'>
<System id="s" name="Small" author="me" date="today" cylesPerSecond="12.5" syncPlots="true" port="54923">
  <Note>About &lt;this&gt;</Note>
  <Process id="p" name="P" hostname="host" port="1" enableModule="false" path="" color="#00FF00">
    <Module name="moduleTest">
      <Parameter name="gain" value="3"/>
      <XRefHolder name="InputFromGroup"><XRef name="_in" target="a"/></XRefHolder>
      <XRefHolder name="OutputToGroup"><XRef name="_out" target=""/></XRefHolder>
    </Module>
    <Note/>
    <DiagramIcon x="-10" y="20" width="50" height="60"/>
    <Group id="a" name="A " color="#FFFFFF">
      <Topology><TopologyRect hcount="3" vcount="2" cylinderHor="false" cylinderVert="true"/></Topology>
      <Neuron name="neuronLinearThreshold">
        <Parameter name="threshold" value="0.5"/>
        <Parameter name="clipVm" value="true"/>
      </Neuron>
      <DiagramIcon x="1" y="2"/>
    </Group>
    <Group id="b" name="B">
      <Topology><TopologySparse><Point x="2" y="3"/><Point x="5" y="4"/></TopologySparse></Topology>
      <Neuron name="neuronRandomSpike"/>
      <Note>Line 1
Line 2</Note>
    </Group>
  </Process>
  <Connection id="c" name="A to B" source="a" target="b" type="inhibitory">
    <Pattern><PatternForeach><Region xstart="1" ystart="2" width="3" height="1"/><List><Point x="2" y="3"/></List></PatternForeach></Pattern>
    <Arborization><ArbEllipseWindow innerwidth="1" innerheight="2" outerwidth="3" outerheight="4" direction="PF" initialization_probability="0.5"/></Arborization>
    <AttenuationFunction><FunGaussian min="0.1" max="0.9" sigma="1.5"/></AttenuationFunction>
    <DelayFunction><FunBlock min="1" max="4" width="3" height="7"/></DelayFunction>
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="-0.25"/></Synapse>
    <Note>n</Note>
    <DiagramLine APSource="3" APTarget="15"><Point x="-4" y="5"/></DiagramLine>
  </Connection>
</System>
)";

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

/// The model of a text without mistakes.
inline model::System system_of(const std::string& text) {
    Diagnostics diagnostics;
    const auto system = xml::parse_system("test.iqr", text, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(system);
    REQUIRE(diagnostics.all().empty());
    return *system;
}

/// A module with a parameter of each number kind, a required input and an optional output of fixed size.
struct TestModule {
    int gain = 1;
    double rate = 0.5;
    static void describe(ModuleSpec<TestModule>& s) {
        s.name("moduleTest", "Test");
        s.param("gain", &TestModule::gain).label("Gain").range(0, 100).doc("Factor of the input.");
        s.param("rate", &TestModule::rate).label("Rate").range(0, 1).doc("Part per cycle.");
        s.input("_in", "Where it reads");
        s.output("_out", "Where it writes").size(3, 2).optional();
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const {
        if (gain == 13)
            diagnostics.error(at_parameter("gain"), "unlucky gain in " + ports.process, "choose another");
        if (gain == 14) diagnostics.error(at_port("_in"), "input is " + ports.inputs[0].path);
    }
    void update(ModuleFrame&) {}
};

/// A synapse type that learns from a state of its target.
struct TestLearningSynapse {
    static void describe(SynapseSpec<TestLearningSynapse>& s) {
        s.name("synapseLearning", "Learning")
            .output("psp", "Postsynaptic potential")
            .feedback("postact", "Activity of the target");
    }
    double output(double) const { return 0; }
};

/// A small and fixed set of types, so that types that are added later do not change the tests.
inline Registry few_types() {
    Registry registry;
    registry.add(neuron_type<LinearThreshold>());
    registry.add(neuron_type<RandomSpike>());
    registry.add(synapse_type<FixedWeight>());
    registry.add(synapse_type<TestLearningSynapse>());
    registry.add(module_type<TestModule>());
    return registry;
}

}  // namespace forage::test
