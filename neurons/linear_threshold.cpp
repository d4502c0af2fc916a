#include "neurons/linear_threshold.h"

#include <algorithm>

#include "core/types/simd.h"
#include "neurons/membrane.h"

namespace forage {

void LinearThreshold::describe(NeuronSpec<LinearThreshold>& s) {
    s.name("neuronLinearThreshold", "Linear threshold")
        .doc("Sums its inputs, leaks, silent below threshold.");
    s.cells_independent();
    membrane::describe_potential(s);
    membrane::describe_firing(s);
    s.state("vm", "Membrane potential").output("act", "Activity");
}

void LinearThreshold::check(Problems& problems) const { membrane::check_bounds(*this, problems); }

namespace {

FORAGE_SIMD void activate(const double* vm, const double* mask, double threshold, Index cells, double* act) {
    if (mask)
        for (Index i = 0; i < cells; ++i) act[i] = vm[i] < threshold ? 0.0 : vm[i] * mask[i];
    else
        for (Index i = 0; i < cells; ++i) act[i] = vm[i] < threshold ? 0.0 : vm[i];
}

}  // namespace

void LinearThreshold::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    const double* mask = membrane::mask(c, probability);
    const auto potential = membrane::potential(*this, c);
    constexpr Index block =
        1024;  // cells; what the first loop writes is still near when the second one reads it
    for (Index i = 0, end = c.size(); i < end; i += block) {
        const Index cells = std::min(block, end - i);
        membrane::integrate(potential, i, cells, vm.data(), vm.data());
        activate(vm.data() + i, mask ? mask + i : nullptr, threshold, cells, act.data() + i);
    }
}

}  // namespace forage
