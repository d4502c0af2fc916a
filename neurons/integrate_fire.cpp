#include "neurons/integrate_fire.h"

#include "neurons/membrane.h"

namespace forage {

void IntegrateFire::describe(NeuronSpec<IntegrateFire>& s) {
    using T = IntegrateFire;
    s.name("neuronIntegrateFire", "Integrate & fire")
        .doc("Sums its inputs, leaks, spikes and is reset at threshold.");
    s.cells_independent();
    membrane::describe_potential(s);
    membrane::describe_firing(s);
    s.param("spkAmpl", &T::amplitude)
        .label("Spike amplitude")
        .range(0, 1)
        .doc("Divides the reset; a spike is always 1.");
    s.param("vmReset", &T::reset)
        .label("Membrane potential reset")
        .range(0, 1)
        .doc("What a spike takes from vm.");
    s.state("vm", "Membrane potential").output("act", "Activity");
}

void IntegrateFire::check(Problems& problems) const {
    membrane::check_bounds(*this, problems);
    if (amplitude != 0 && amplitude != 1)
        problems.all.push_back({"spkAmpl does not scale the spike, which is always 1; it divides the reset",
                                "leave it at 1, and scale the weights of the connections instead",
                                "spkAmpl",
                                {}});
}

void IntegrateFire::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    membrane::integrate(membrane::potential(*this, c), 0, c.size(), vm.data(), vm.data());
    act = (vm >= threshold).select(Eigen::ArrayXd::Ones(c.size()), 0.0);  // NaN is silent
    if (const double* mask = membrane::mask(c, probability)) act *= ConstColumn(mask, c.size());
    if (amplitude != 0) vm -= reset * act / amplitude;
}

}  // namespace forage
