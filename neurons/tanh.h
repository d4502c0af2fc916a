#pragma once

#include <cmath>

#include "core/types/membrane.h"

namespace forage {

/// A cell has the activity act = tanh(slope * (vm - midpoint)), between -1 and 1. The original names this
/// type and ships no working version of it.
struct TanH {
    Membrane membrane;
    double midpoint = 0, slope = 1;

    struct Cell {
        double vm = 0, act = 0;
    };

    static void describe(NeuronSpec<TanH>& s) {
        using T = TanH;
        s.name("neuronTanH", "Hyperbolic tangent")
            .doc("Sums its inputs, leaks, squashes the potential to -1..1.");
        Membrane::describe(s, &T::membrane);
        s.param("midpoint", &T::midpoint)
            .label("Midpoint")
            .range(-1, 1)
            .doc("Potential at which the activity is 0.");
        s.param("slope", &T::slope)
            .label("Slope")
            .range(0, 10)
            .doc("Steepness of the activity at the midpoint.");
        s.state("vm", &Cell::vm, "Membrane potential");
        s.output("act", &Cell::act, "Activity");
    }
    void check(Diagnostics& diagnostics) const { membrane.check(diagnostics); }

    void update(Cell& c, Input& in) const {
        c.vm = membrane.integrate(c.vm, in);
        c.act = std::tanh(slope * (c.vm - midpoint));
    }
};

}  // namespace forage
