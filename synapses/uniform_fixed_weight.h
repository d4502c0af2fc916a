#pragma once

#include "core/types/synapse.h"

namespace forage {

/// psp = weight * pre: the fixed weight type under the name that older files use.
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
