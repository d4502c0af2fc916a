// A synapse whose output() tells something else than its update() puts out.
#include <forage/plugin.h>

struct OtherOutput {
    static void describe(forage::SynapseSpec<OtherOutput>& s) {
        s.name("synapseOtherOutput", "Other output").doc("Broken on purpose.");
        s.state("weight", "Weight").output("psp", "Potential").event_driven();
    }
    void update(forage::SynapseColumns& c) const {
        c.state(0) += 0.1 * c.pre();
        c.state(1) = c.state(0) * c.pre();
    }
    void output(forage::SynapseColumns& c) const { c.state(1) = c.state(0); }
};

FORAGE_PLUGIN(OtherOutput);
