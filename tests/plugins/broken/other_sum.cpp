// A synapse whose update_and_add() adds something else than its update() puts out.
#include <forage/plugin.h>

struct OtherSum {
    static void describe(forage::SynapseSpec<OtherSum>& s) {
        s.name("synapseOtherSum", "Other sum").doc("Broken on purpose.");
        s.state("weight", "Weight").output("psp", "Potential").event_driven();
    }
    void update(forage::SynapseColumns& c) const {
        c.state(0) += 0.1 * c.pre();
        output(c);
    }
    void output(forage::SynapseColumns& c) const { c.state(1) = c.state(0) * c.pre(); }
    void update_and_add(forage::SynapseColumns& c) const {
        c.sums() += c.state(0) * c.pre();  // before it learns
        c.state(0) += 0.1 * c.pre();
    }
};

FORAGE_PLUGIN(OtherSum);
