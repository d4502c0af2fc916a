#pragma once

#include "core/types/membrane.h"

namespace forage {

/// A cell whose vm reaches the threshold has act = vm, and other cells have act = 0. With a probability below
/// 1, each cell is silent in a random part of the cycles.
struct LinearThreshold {
    Membrane membrane;
    double probability = 1, threshold = 0;

    struct Cell {
        double vm = 0, act = 0;
    };

    static void describe(NeuronSpec<LinearThreshold>& s) {
        using T = LinearThreshold;
        s.name("neuronLinearThreshold", "Linear threshold")
            .doc("Sums its inputs, leaks, silent below threshold.");
        Membrane::describe(s, &T::membrane);
        s.param("probability", &T::probability)
            .label("Probability")
            .range(0, 1)
            .doc("Chance per cycle that a cell is active.");
        s.param("threshold", &T::threshold)
            .label("Threshold potential")
            .range(0, 1)
            .doc("Potential below which the activity is 0.");
        s.state("vm", &Cell::vm, "Membrane potential").oldest();
        s.output("act", &Cell::act, "Activity");
    }
    void check(Diagnostics& diagnostics) const { membrane.check(diagnostics); }

    double event_probability() const { return chance(probability); }
    void update(Cell& c, Input& in) const {
        c.vm = membrane.integrate(c.vm, in);
        c.act = c.vm < threshold ? 0 : c.vm * in.event;
    }
};

}  // namespace forage
