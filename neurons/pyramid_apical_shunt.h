#pragma once

#include "core/types/neuron.h"

namespace forage {

/// A cell whose vm = vm * vmPrs + exc - inh reaches the threshold spikes (act = 1), and the spike lowers vm
/// by vmReset. Synapses can read two states: `backprop`, the spikes of the previous cycle, and `shunt` = 1 /
/// (1 - mod), which is infinite when the modulatory input is 1.
struct PyramidApicalShunt {
    double persistence = 0, threshold = 0, reset = 0;

    struct Cell {
        double vm = 0, act = 0, shunt = 0, backprop = 0;
    };

    static void describe(NeuronSpec<PyramidApicalShunt>& s) {
        using T = PyramidApicalShunt;
        s.name("neuronPyramidApicalShunt", "Pyramidal with apical shunt");
        s.doc("Spikes at threshold; modulatory input shunts its apical synapses.");
        s.reads(InputKind::excitatory, InputKind::inhibitory, InputKind::modulatory);
        s.param("vmPrs", &T::persistence)
            .label("Membrane persistence")
            .range(0, 1)
            .doc("Part of the potential kept per cycle.");
        s.param("threshold", &T::threshold)
            .label("Threshold potential")
            .range(0, 1)
            .doc("Potential of a spike.");
        s.param("vmReset", &T::reset)
            .label("Membrane potential reset")
            .range(0, 1)
            .doc("What a spike takes from the potential.");
        s.state("vm", &Cell::vm, "Membrane potential").oldest();
        s.output("act", &Cell::act, "Activity", 2);
        s.feedback("shunt", &Cell::shunt, "Apical shunt");
        s.feedback("backprop", &Cell::backprop, "Backpropagating spikes");
    }
    void update(Cell& c, const Input& in) const {
        c.backprop = c.act;
        c.vm = c.vm * persistence + in.excitation - in.inhibition;
        c.act = c.vm >= threshold ? 1 : 0;  // a NaN does not spike
        c.vm -= c.act * reset;
        c.shunt = 1 / (1 - in.modulation);
    }
};

}  // namespace forage
