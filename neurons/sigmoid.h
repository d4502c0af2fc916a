#pragma once

#include <cmath>

#include "core/types/membrane.h"

namespace forage {

/// A cell has the activity act = (1 + tanh(2 * slope * (vm - midpoint))) / 2.
struct Sigmoid {
    Membrane membrane;
    double midpoint = 0, slope = 1;

    struct Cell {
        double vm = 0, act = 0;
    };

    static void describe(NeuronSpec<Sigmoid>& s) {
        using T = Sigmoid;
        s.name("neuronSigmoid", "Sigmoid").doc("Sums its inputs, leaks, squashes the potential to 0..1.");
        Membrane::describe(s, &T::membrane);
        s.param("midpoint", &T::midpoint)
            .label("Midpoint")
            .range(0, 1)
            .doc("Potential at which the activity is 0.5.");
        s.param("slope", &T::slope)
            .label("Slope")
            .range(0, 1)
            .doc("Steepness of the activity at the midpoint.");
        s.state("vm", &Cell::vm, "Membrane potential", 2);
        s.output("act", &Cell::act, "Activity");
    }
    void check(Diagnostics& diagnostics) const { membrane.check(diagnostics); }

    void update(Cell& c, Input& in) const {
        c.vm = membrane.integrate(c.vm, in);
        c.act = 0.5 * (1 + std::tanh(2 * slope * (c.vm - midpoint)));
    }
};

}  // namespace forage
