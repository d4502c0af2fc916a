// Descriptions for papers: equations of the shipped types, and their typesetting.
#include <cmath>
#include <map>

#include "core/equations/declared_types.h"
#include "tests/support/model_text.h"
#include "tests/unit/core/engine/simulations.h"
#include "tools/api/describe/shipped_equations.h"
#include "tools/api/describe/typeset.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Values of parameters that let a type do something with its random input.
const std::map<std::string, std::map<std::string, double>> values = {
    {"neuronIntegrateFire",
     {{"excGain", 0.9},
      {"inhGain", 0.3},
      {"vmPrs", 0.8},
      {"clipVm", 1},
      {"vmMin", 0.1},
      {"vmMax", 1.5},
      {"probability", 1},
      {"threshold", 0.7},
      {"spkAmpl", 0.5},
      {"vmReset", 0.4}}},
    {"neuronLeakyIntegrator",
     {{"tau", 0.2}, {"modGain", 0.5}, {"threshold", 0.05}, {"slope", 2}, {"ceiling", 0.8}}},
    {"neuronLinearThreshold",
     {{"excGain", 0.9},
      {"inhGain", 0.3},
      {"vmPrs", 0.8},
      {"clipVm", 0},
      {"vmMin", 0},
      {"vmMax", 1},
      {"probability", 1},
      {"threshold", 0.4}}},
    {"neuronNumeric", {}},
    {"neuronPyramidApicalShunt", {{"vmPrs", 0.8}, {"threshold", 0.7}, {"vmReset", 0.4}}},
    {"neuronRandomSpike", {{"probability", 1}, {"spkAmpl", 0.7}}},
    {"neuronSigmoid",
     {{"excGain", 0.9},
      {"inhGain", 0.3},
      {"vmPrs", 0.8},
      {"clipVm", 1},
      {"vmMin", 0},
      {"vmMax", 1},
      {"midpoint", 0.3},
      {"slope", 2}}},
    {"neuronTanH",
     {{"excGain", 0.9},
      {"inhGain", 0.3},
      {"vmPrs", 0.8},
      {"clipVm", 0},
      {"vmMin", 0},
      {"vmMax", 1},
      {"midpoint", 0.3},
      {"slope", 2}}}};

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '<' ? std::string("&lt;") : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

/// A group that receives all kinds of random input; of a shipped type, or of one that its equations declare.
std::string system_with(const std::string& type, bool declared) {
    std::string declaration, parameters;
    for (const auto& [name, value] : values.at(type)) {
        const bool flag = name == "clipVm" && !declared;
        const std::string text = flag ? (value != 0 ? "true" : "false") : std::to_string(value);
        (declared ? declaration : parameters) +=
            (declared ? "<Constant name=\"" : "<Parameter name=\"") + name + "\" value=\"" + text + "\"/>";
    }
    std::string equations;
    for (const auto& line : shipped_equations(type)) equations += line + "\n";
    const std::string topology = "<Topology><TopologyRect hcount=\"4\" vcount=\"1\"/></Topology>";
    std::string out = "<System id=\"s\" name=\"S\" cylesPerSecond=\"25\">";
    if (declared)
        out += "<NeuronType name=\"twin\">" + declaration + "<Equations>" + escaped(equations) +
               "</Equations></NeuronType>";
    out += "<Process id=\"p\" name=\"P\">";
    for (const char* source : {"exc", "inh", "mod"})
        out += std::string("<Group id=\"") + source + "\" name=\"" + source + "\">" + topology +
               "<Neuron name=\"neuronRandomSpike\"><Parameter name=\"probability\" value=\"0.5\"/>"
               "<Parameter name=\"spkAmpl\" value=\"0.6\"/></Neuron></Group>";
    out += "<Group id=\"t\" name=\"Target\">" + topology + "<Neuron name=\"" +
           (declared ? std::string("twin") : type) + "\">" + parameters + "</Neuron></Group></Process>";
    for (const char* source : {"exc", "inh", "mod"})
        out += std::string("<Connection id=\"c") + source + "\" name=\"C" + source + "\" type=\"" +
               (*source == 'e'   ? "excitatory"
                : *source == 'i' ? "inhibitory"
                                 : "modulatory") +
               "\" source=\"" + source + "\" target=\"t\"/>";
    return out + "</System>";
}

std::vector<double> activities(const std::string& text) {
    const auto system = system_of(text);
    Registry types = registry();
    Diagnostics diagnostics;
    equations::add_types(system, types, diagnostics);
    INFO(format(diagnostics));
    REQUIRE_FALSE(diagnostics.failed());
    auto simulation = run(system, types);
    std::vector<double> out;
    for (int cycle = 0; cycle < 60; ++cycle) {
        simulation.step();
        for (const double v : activity(simulation, "P/Target")) out.push_back(v);
    }
    return out;
}

}  // namespace

TEST_CASE("the equations of shipped neuron types compute what the types compute") {
    const Registry types = registry();
    for (const auto& [name, parameters] : values) {
        INFO(name);
        CHECK(types.neuron(name)->parameters.size() == parameters.size());
        const auto of_type = activities(system_with(name, false));
        const auto of_equations = activities(system_with(name, true));
        REQUIRE(of_type.size() == of_equations.size());
        bool active = false;
        for (std::size_t i = 0; i < of_type.size(); ++i) {
            CHECK(std::abs(of_type[i] - of_equations[i]) < 1e-9);
            active = active || of_type[i] != 0;
        }
        CHECK(active);
    }
}

TEST_CASE("every shipped type has equations, but the critic, whose cells see each other") {
    const Registry types = registry();
    for (const auto& [name, type] : types.neurons())
        if (name.starts_with("neuron")) CHECK(shipped_equations(name).empty() == (name == "neuronTDValue"));
    for (const auto& [name, type] : types.synapses())
        if (name.starts_with("synapse")) CHECK_FALSE(shipped_equations(name).empty());
}

TEST_CASE("equations are typeset") {
    const auto one = [](const std::string& line) { return typeset_equations({line}).at(0); };
    CHECK(one("dv/dt = (a * (b * v - u)) / tau_m") ==
          R"(\frac{\mathrm{d}v}{\mathrm{d}t} = \frac{a\,(b\,v - u)}{\tau_{\mathrm{m}}})");
    CHECK(one("u = 0.04 * v^2 - (a - b) - 1e-5 * post.x'") ==
          R"(u = 0.04\,v^{2} - (a - b) - 10^{-5}\,x'_{\mathrm{post}})");
    CHECK(one("output y = if(x >= 1 and not z, max(a, b, 2 * 3), exp(-x))") ==
          R"(\text{output }y = \begin{cases}\max(a, b, 2 \cdot 3) & \text{if }x \ge 1\ \text{and}\ )"
          R"(\text{not}\ z\\ \exp(-x) & \text{otherwise}\end{cases})");
    CHECK(typeset_equations({"spike = v' >= 30", "when spike: v' = c, u' = u' + d"}) ==
          std::vector<std::string>{
              R"(\mathit{spike} = v' \ge 30)",
              R"(\text{when }\mathit{spike}\colon\quad v' = c,\quad\allowbreak u' = u' + d)"});
    CHECK(typeset_name("g_Na") == R"(g_{\mathrm{Na}})");
    CHECK(typeset_name("x1") == R"(x_{\mathrm{1}})");
    CHECK(typeset_name("lambda") == R"(\lambda)");
}
