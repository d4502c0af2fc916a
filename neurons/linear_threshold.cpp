#include "neurons/linear_threshold.h"

#include "core/base/simd.h"
#include "neurons/membrane.h"

namespace forage {

void LinearThreshold::describe(NeuronSpec<LinearThreshold>& s) {
    s.name("neuronLinearThreshold", "Linear threshold")
        .doc("Sums its inputs, leaks, silent below threshold.");
    s.elementwise();
    membrane::describe_potential(s);
    membrane::describe_firing(s);
    s.state("vm", "Membrane potential").output("act", "Activity");
}

void LinearThreshold::check(Diagnostics& diagnostics) const { membrane::check_bounds(*this, diagnostics); }

namespace {

FORAGE_SIMD void update(const membrane::Potential& p, double threshold, const double* mask, Index cells,
                        double* vm, double* act) {
    if (mask)
        membrane::integrate(p, cells, vm, [=](Index i, double v) {
            vm[i] = v;
            act[i] = v < threshold ? 0.0 : v * mask[i];
        });
    else
        membrane::integrate(p, cells, vm, [=](Index i, double v) {
            vm[i] = v;
            act[i] = v < threshold ? 0.0 : v;
        });
}

}  // namespace

void LinearThreshold::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    forage::update(membrane::potential(*this, c), threshold, membrane::mask(c, probability), c.size(),
                   vm.data(), act.data());
}

}  // namespace forage
