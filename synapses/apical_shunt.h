#pragma once

#include "core/types/synapse.h"

namespace forage {

/// Multiplies the input by the shunt of the target cell: psp = pre * shunt.
struct ApicalShunt {
    struct Target {
        double shunt = 0;
    };

    static void describe(SynapseSpec<ApicalShunt>& s) {
        s.name("synapseApicalShunt", "Apical shunt")
            .doc("Passes its input on, times the shunt of its target.");
        s.output("psp", "Postsynaptic potential");
        s.feedback("apicalFeedback", "Apical feedback (declared by the original, without effect)", false);
        s.feedback("apicalShunt", &Target::shunt, "Apical shunt");
    }
    double output(double pre, const Target& target) const { return pre * target.shunt; }
};

}  // namespace forage
