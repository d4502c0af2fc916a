#include "neurons/linear_threshold.h"

#include "neurons/membrane.h"

namespace forage {

void LinearThreshold::describe(NeuronSpec<LinearThreshold>& s) {
    using T = LinearThreshold;
    s.name("neuronLinearThreshold", "Linear threshold").doc("Sums its inputs, leaks, silent below threshold.");
    membrane::describe_potential(s);
    s.param("probability", &T::probability).label("Probability").range(0, 1).doc("Chance per cycle that a cell is active.");
    s.param("threshold", &T::threshold).label("Threshold potential").range(0, 1).doc("Potential below which act is 0.");
    s.state("vm", "Membrane potential").output("act", "Activity");
}

void LinearThreshold::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    membrane::integrate(*this, c, vm, vm);
    act = vm;
    membrane::silence(c, act, probability);
    act = (vm < threshold).select(0.0, act);
}

}  // namespace forage
