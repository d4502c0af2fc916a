#pragma once

#include "core/types/neuron.h"

namespace forage {

/// A cell whose potential follows its input with a time constant (Euler's method), and whose activity is
/// linear between a threshold and a ceiling: da/dt = (u - a) / tau, as in Gurney, Prescott and Redgrave
/// (2001), Biol. Cybern. 84:401.
struct LeakyIntegrator {
    double tau = 0.1, modulation_gain = 0, threshold = 0, slope = 1, ceiling = 1;
    double dt = 0.04;

    struct Cell {
        double a = 0, act = 0;
    };

    static void describe(NeuronSpec<LeakyIntegrator>& s) {
        using T = LeakyIntegrator;
        s.name("neuronLeakyIntegrator", "Leaky integrator")
            .doc("Follows its input with a time constant; linear between threshold and ceiling.")
            .reads(InputKind::excitatory, InputKind::inhibitory, InputKind::modulatory)
            .dt(&T::dt);
        s.param("tau", &T::tau)
            .label("Time constant")
            .time_constant()
            .doc("Time in which a covers 63 % of a step.");
        s.param("modGain", &T::modulation_gain)
            .label("Modulation gain")
            .range(-10, 10)
            .doc("Excitation is multiplied by 1 + modGain * modulation.");
        s.param("threshold", &T::threshold)
            .label("Threshold")
            .range(-1, 1)
            .doc("Potential at which the activity begins.");
        s.param("slope", &T::slope)
            .label("Slope")
            .range(0, 10)
            .doc("Activity per potential above the threshold.");
        s.param("ceiling", &T::ceiling).label("Ceiling").range(0, 10).doc("Highest activity.");
        s.state("a", &Cell::a, "Potential");
        s.output("act", &Cell::act, "Activity");
    }

    void update(Cell& c, const Input& in) const {
        const double u = in.excitation * (1 + modulation_gain * in.modulation) - in.inhibition;
        c.a += (u - c.a) * dt / tau;
        const double y = slope * (c.a - threshold);
        c.act = y < 0 ? 0 : y > ceiling ? ceiling : y;
    }
};

}  // namespace forage
