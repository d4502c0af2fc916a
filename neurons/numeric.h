#pragma once

#include "core/types/neuron.h"

namespace forage {

/// Passes its input on: act = exc - inh.
struct Numeric {
    struct Cell {
        double pot = 0, act = 0;
    };

    static void describe(NeuronSpec<Numeric>& s) {
        s.name("neuronNumeric", "Numeric").doc("Passes the difference of its inputs on.");
        s.reads(InputKind::excitatory, InputKind::inhibitory);
        s.state("pot", &Cell::pot, "Membrane potential").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const Input& in) const { c.act = c.pot = in.excitation - in.inhibition; }
};

}  // namespace forage
