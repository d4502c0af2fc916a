#pragma once

#include "core/types/synapse.h"

namespace forage {

/// Multiplies the input by a constant: psp = weight * pre, with the same weight for all synapses of the
/// connection.
struct FixedWeight {
    double weight = 1;

    static void describe(SynapseSpec<FixedWeight>& s) {
        s.name("synapseFixedWeight", "Fixed weight").doc("Passes its input on, times a constant.");
        s.param("weight", &FixedWeight::weight).label("Weight").range(-1, 1).doc("Factor of every synapse.");
        s.output("psp", "Postsynaptic potential");
    }
    double gain() const { return weight; }
};

}  // namespace forage
