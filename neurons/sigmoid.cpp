#include "neurons/sigmoid.h"

#include "core/base/simd.h"
#include "neurons/membrane.h"

namespace forage {

void Sigmoid::describe(NeuronSpec<Sigmoid>& s) {
    using T = Sigmoid;
    s.name("neuronSigmoid", "Sigmoid").doc("Sums its inputs, leaks, squashes the potential to 0..1.");
    s.elementwise();
    membrane::describe_potential(s);
    s.param("midpoint", &T::midpoint).label("Midpoint").range(0, 1).doc("Potential at which act is 0.5.");
    s.param("slope", &T::slope).label("Slope").range(0, 1).doc("Steepness of act at the midpoint.");
    s.state("vm", "Membrane potential", 2).output("act", "Activity");
}

void Sigmoid::check(Diagnostics& diagnostics) const { membrane::check_bounds(*this, diagnostics); }

namespace {

FORAGE_SIMD void integrate(const membrane::Potential& p, Index cells, const double* previous, double* vm) {
    membrane::integrate(p, cells, previous, [=](Index i, double v) { vm[i] = v; });
}

}  // namespace

void Sigmoid::update(NeuronColumns& c) const {
    auto [vm, act] = c.states<2>();
    integrate(membrane::potential(*this, c), c.size(), c.past(0, 1).data(), vm.data());
    act = 0.5 * (1 + (2 * slope * (vm - midpoint)).unaryExpr([](double x) { return std::tanh(x); }));
}

}  // namespace forage
