#pragma once

#include "core/types/membrane.h"

namespace forage {

/// A cell whose vm reaches the threshold spikes (act = 1) with the given probability. A spike lowers vm by
/// vmReset / spkAmpl. The amplitude does not scale the spike, as in the original.
struct IntegrateFire {
    Membrane membrane;
    double probability = 1, threshold = 0, amplitude = 1, reset = 0;

    struct Cell {
        double vm = 0, act = 0;
    };

    static void describe(NeuronSpec<IntegrateFire>& s) {
        using T = IntegrateFire;
        s.name("neuronIntegrateFire", "Integrate & fire")
            .doc("Sums its inputs, leaks, spikes and is reset at threshold.");
        Membrane::describe(s, &T::membrane);
        s.param("probability", &T::probability)
            .label("Probability")
            .range(0, 1)
            .doc("Chance per cycle that a cell is active.");
        s.param("threshold", &T::threshold)
            .label("Threshold potential")
            .range(0, 1)
            .doc("Potential below which the activity is 0.");
        s.param("spkAmpl", &T::amplitude)
            .label("Spike amplitude")
            .range(0, 1)
            .doc("Divides the reset; a spike is always 1.");
        s.param("vmReset", &T::reset)
            .label("Membrane potential reset")
            .range(0, 1)
            .doc("What a spike takes from the potential.");
        s.state("vm", &Cell::vm, "Membrane potential").oldest();
        s.output("act", &Cell::act, "Activity");
    }
    void check(Diagnostics& diagnostics) const {
        membrane.check(diagnostics);
        if (amplitude != 0 && amplitude != 1)
            diagnostics.warning(at_parameter("spkAmpl"),
                                "spkAmpl does not scale the spike, which is always 1; it divides the reset",
                                "leave it at 1, and scale the weights of the connections instead");
    }

    double event_probability() const { return chance(probability); }
    void update(Cell& c, Input& in) const {
        const double loss = amplitude == 0 ? 0 : reset / amplitude;
        c.vm = membrane.integrate(c.vm, in);
        c.act = c.vm >= threshold ? in.event : 0;  // a NaN does not spike
        c.vm -= c.act != 0 ? loss : 0;
    }
};

}  // namespace forage
