#pragma once

#include "core/types/synapse.h"

namespace forage {

/// Multiplies the input by a constant: psp = weight * pre. Older files use this name for the fixed weight
/// type.
struct UniformFixedWeight {
    double weight = 1;

    static void describe(SynapseSpec<UniformFixedWeight>& s) {
        s.name("synapseUniformFixedWeight", "Uniform fixed weight")
            .doc("Passes its input on, times a constant.");
        s.param("weight", &UniformFixedWeight::weight)
            .label("Weight")
            .range(-1, 1)
            .doc("Factor of every synapse.");
        s.output("psp", "Postsynaptic potential");
    }
    double gain() const { return weight; }
};

}  // namespace forage
