#include "neurons/integrate_fire.h"

#include "core/base/simd.h"
#include "neurons/membrane.h"

namespace forage {

void IntegrateFire::describe(NeuronSpec<IntegrateFire>& s) {
    using T = IntegrateFire;
    s.name("neuronIntegrateFire", "Integrate & fire")
        .doc("Sums its inputs, leaks, spikes and is reset at threshold.");
    s.elementwise();
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

void IntegrateFire::check(Diagnostics& diagnostics) const {
    membrane::check_bounds(*this, diagnostics);
    if (amplitude != 0 && amplitude != 1)
        diagnostics.warning(at_parameter("spkAmpl"),
                            "spkAmpl does not scale the spike, which is always 1; it divides the reset",
                            "leave it at 1, and scale the weights of the connections instead");
}

namespace {

/// What a cell loses that fires, and one that does not.
struct Reset {
    double active = 0, silent = 0;
};

FORAGE_SIMD void update(const membrane::Potential& p, double threshold, Reset reset, const double* mask,
                        Index cells, double* vm, double* act) {
    if (mask)
        membrane::integrate(p, cells, vm, [=](Index i, double v) {
            act[i] = v >= threshold ? mask[i] : 0.0;  // NaN is silent
            vm[i] = v - (v >= threshold && mask[i] != 0 ? reset.active : reset.silent);
        });
    else
        membrane::integrate(p, cells, vm, [=](Index i, double v) {
            act[i] = v >= threshold ? 1.0 : 0.0;
            vm[i] = v - (v >= threshold ? reset.active : reset.silent);
        });
}

}  // namespace

void IntegrateFire::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    const Reset loss = amplitude == 0 ? Reset() : Reset{reset * 1.0 / amplitude, reset * 0.0 / amplitude};
    forage::update(membrane::potential(*this, c), threshold, loss, membrane::mask(c, probability), c.size(),
                   vm.data(), act.data());
}

}  // namespace forage
