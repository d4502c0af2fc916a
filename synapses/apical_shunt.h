#pragma once

#include "core/types/synapse.h"

namespace forage {

/// psp = pre * shunt of the target cell.
struct ApicalShunt {
    static void describe(SynapseSpec<ApicalShunt>& s) {
        s.name("synapseApicalShunt", "Apical shunt")
            .doc("Passes its input on, times the shunt of its target.");
        s.output("psp", "Postsynaptic potential");
        s.feedback("apicalFeedback", "Apical feedback (declared by the original, without effect)", false);
        s.feedback("apicalShunt", "Apical shunt");
    }
    void update(SynapseColumns& c) const { c.state(0) = c.pre() * c.feedback(1); }
};

}  // namespace forage
