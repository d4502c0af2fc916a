#include "neurons/linear_threshold.h"

#include "neurons/membrane.h"

namespace forage {

void LinearThreshold::describe(NeuronSpec<LinearThreshold>& s) {
    s.name("neuronLinearThreshold", "Linear threshold")
        .doc("Sums its inputs, leaks, silent below threshold.");
    membrane::describe_potential(s);
    membrane::describe_firing(s);
    s.state("vm", "Membrane potential").output("act", "Activity");
}

void LinearThreshold::check(Problems& problems) const { membrane::check_bounds(*this, problems); }

void LinearThreshold::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    membrane::integrate(*this, c, vm, vm);
    act = vm;
    membrane::silence(c, act, probability);
    act = (vm < threshold).select(0.0, act);
}

}  // namespace forage
