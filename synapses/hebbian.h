#pragma once

#include "core/types/synapse.h"

namespace forage {

/// Hebbian learning: weight += (postact * pre) * lrate, beginning with 0; then synpot = weight * pre. postact
/// is the state of the target that the file names, taken as many cycles ago as the synapse's delay. Weights
/// do not decay, as in the original.
struct Hebbian {
    double rate = 0.1, decay = 0.1;

    struct Synapse {
        double weight = 0;
    };
    struct Target {
        double post = 0;
    };

    static void describe(SynapseSpec<Hebbian>& s) {
        using T = Hebbian;
        s.name("synapseHebbian", "Hebbian").doc("Strengthens where source and target are active together.");
        s.param("lrate", &T::rate)
            .label("Learning Rate")
            .range(0, 1)
            .doc("Growth per cycle at full activity.");
        s.param("decay", &T::decay)
            .label("Decay")
            .range(0, 1)
            .doc("Without effect: the original ignores it.");
        s.state("weight", &Synapse::weight, "Weight");
        s.output("synpot", "Synaptic potential");
        s.feedback("postact", &Target::post, "Postsynaptic activity");
        s.event_driven();
    }
    void check(Diagnostics& diagnostics) const {
        if (decay != 0 && decay != Hebbian{}.decay)
            diagnostics.warning(at_parameter("decay"),
                                "decay has no effect: weights do not decay, as in the original");
    }

    void update(Synapse& s, double pre, const Target& target) const { s.weight += target.post * pre * rate; }
    double output(const Synapse& s, double pre) const { return s.weight * pre; }
};

}  // namespace forage
