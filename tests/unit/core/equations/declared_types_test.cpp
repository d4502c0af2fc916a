// Types that a system declares, in the engine.
#include "core/equations/declared_types.h"

#include "tests/support/model_text.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// One cell per group: Source, whose states are n = 1, 2, 3, ... and its output 10 n, and Target.
engine::Simulation run_with(const std::string& target, const std::string& connections,
                            const std::string& source = "n' = n + 1; output y = 10 * n'") {
    const std::string cell = "<Topology><TopologyRect hcount=\"1\" vcount=\"1\"/></Topology>";
    const auto system = system_of(
        "<System id=\"s\" name=\"S\" cylesPerSecond=\"10\"><NeuronType name=\"counting\"><Equations>" +
        source + "</Equations></NeuronType><NeuronType name=\"target\"><Equations>" + target +
        "</Equations></NeuronType><Process id=\"p\" name=\"P\"><Group id=\"a\" name=\"Source\">" + cell +
        "<Neuron name=\"counting\"/></Group><Group id=\"b\" name=\"Target\">" + cell +
        "<Neuron name=\"target\"/></Group></Process>" + connections + "</System>");
    Registry types_of_system = registry();
    Diagnostics diagnostics;
    equations::add_types(system, types_of_system, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(diagnostics.all().empty());
    return run(system, types_of_system);
}

std::string connection(const std::string& attributes, const std::string& content = "") {
    return "<Connection id=\"c" + std::to_string(std::hash<std::string>{}(attributes)) +
           "\" name=\"C\" source=\"a\" target=\"b\" " + attributes + "><Weights>2</Weights>" + content +
           "</Connection>";
}

/// What the target has received in each of the first cycles.
std::vector<double> outputs(engine::Simulation s, int cycles) {
    std::vector<double> out;
    for (int i = 0; i < cycles; ++i) s.step(), out.push_back(activity(s, "P/Target")[0]);
    return out;
}

}  // namespace

TEST_CASE("a connection transmits the output or another state of its source") {
    CHECK(outputs(run_with("output x = exc", connection("")), 4) == std::vector<double>{0, 20, 40, 60});
    CHECK(outputs(run_with("output x = exc", connection("state=\"n\"")), 4) ==
          std::vector<double>{0, 2, 4, 6});
    const std::string delay = "<DelayFunction><FunUniform value=\"2\"/></DelayFunction>";
    CHECK(outputs(run_with("output x = exc", connection("state=\"n\"", delay)), 6) ==
          std::vector<double>{0, 0, 0, 2, 4, 6});
}

TEST_CASE("a state that is transmitted may change while the output rests") {
    const char* resting = "n' = n + 1; output y = 0 * n'";
    CHECK(outputs(run_with("output x = exc", connection("state=\"n\""), resting), 3) ==
          std::vector<double>{0, 2, 4});
}

TEST_CASE("further inputs of a type have sums of their own") {
    const std::string both =
        connection("") + connection("input=\"push\" state=\"n\"") + connection("input=\"pull\"");
    CHECK(outputs(run_with("input push; input pull; output x = exc + 1000 * push - pull / 2", both), 3) ==
          std::vector<double>{0, 20 + 2000 - 10, 40 + 4000 - 20});
}
