#pragma once

#include "core/types/neuron.h"

namespace forage {

/// act = exc - inh: passes numbers on as they are.
struct Numeric {
    static void describe(NeuronSpec<Numeric>& s) {
        s.name("neuronNumeric", "Numeric").doc("Passes the difference of its inputs on.");
        s.elementwise();
        s.reads(InputKind::excitatory, InputKind::inhibitory);
        s.state("pot", "Membrane potential").output("act", "Activity");
    }
    void update(NeuronColumns& c) const {
        auto [pot, act] = c.states<2>();
        pot = c.excitation() - c.inhibition();
        act = pot;
    }
};

}  // namespace forage
