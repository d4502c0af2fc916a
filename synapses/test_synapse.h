#pragma once

#include "core/types/synapse.h"

namespace forage {

/// Passes the input on as it is: psp = pre. The original has this type to test feedback: it declares two
/// feedback inputs and uses neither.
struct TestSynapse {
    static void describe(SynapseSpec<TestSynapse>& s) {
        s.name("synapseTest", "Test").doc("Passes its input on as it is.");
        s.output("psp", "Postsynaptic potential");
        s.feedback("apicalFeedback", "Apical feedback (without effect)", false);
        s.feedback("apicalShunt", "Apical shunt (without effect)", false);
    }
    double gain() const { return 1; }
};

}  // namespace forage
