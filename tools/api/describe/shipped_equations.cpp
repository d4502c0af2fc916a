#include "tools/api/describe/shipped_equations.h"

#include <iterator>

namespace forage {
namespace {

struct TypeEquations {
    std::string_view type;
    std::vector<std::string> lines;
};

std::vector<std::string> membrane_equations(std::vector<std::string> more) {
    std::vector<std::string> out = {"u = vmPrs * vm + excGain * exc - inhGain * inh"};
    out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    return out;
}

// tests/unit/tools/api/describe_test.cpp declares a type from each of these and compares it with the shipped
// one.
const std::vector<TypeEquations>& all_equations() {
    static const std::string clipped = "if(clipVm, clip(u, vmMin, vmMax), u)";
    static const std::vector<TypeEquations> all = {
        {"neuronIntegrateFire",
         membrane_equations({"v = " + clipped, "spike = uniform() < probability and v >= threshold",
                             "vm' = if(spike and spkAmpl != 0, v - vmReset / spkAmpl, v)",
                             "output act = spike"})},
        {"neuronLeakyIntegrator",
         {"da/dt = (exc * (1 + modGain * mod) - inh - a) / tau",
          "output act = clip(slope * (a' - threshold), 0, ceiling)"}},
        {"neuronLinearThreshold",
         membrane_equations(
             {"vm' = " + clipped, "output act = if(uniform() < probability and vm' >= threshold, vm', 0)"})},
        {"neuronNumeric", {"output act = exc - inh"}},
        {"neuronPyramidApicalShunt",
         {"backprop' = act", "v = vmPrs * vm + exc - inh", "output act = v >= threshold",
          "vm' = v - act' * vmReset", "shunt' = 1 / (1 - mod)"}},
        {"neuronRandomSpike", {"output act = if(uniform() < probability, spkAmpl, 0)"}},
        {"neuronSigmoid", membrane_equations({"vm' = " + clipped,
                                              "output act = (1 + tanh(2 * slope * (vm' - midpoint))) / 2"})},
        {"neuronTanH",
         membrane_equations({"vm' = " + clipped, "output act = tanh(slope * (vm' - midpoint))"})},
        {"synapseApicalShunt", {"output psp = pre' * post.apicalShunt"}},
        {"synapseFixedWeight", {"output psp = weight * pre'"}},
        {"synapseHebbian",
         {"weight' = weight + lrate * post.postact * pre'", "output synpot = weight' * pre'"}},
        {"synapseTest", {"output psp = pre'"}},
        {"synapseUniformFixedWeight", {"output psp = weight * pre'"}}};
    return all;
}

}  // namespace

std::vector<std::string> shipped_equations(std::string_view type) {
    for (const auto& e : all_equations())
        if (e.type == type) return e.lines;
    return {};
}

}  // namespace forage
