// A synapse with an output() that would never be called.
#include <forage/plugin.h>

struct SilentOutput {
    static void describe(forage::SynapseSpec<SilentOutput>& s) {
        s.name("synapseSilentOutput", "Silent output").doc("Broken on purpose.");
        s.state("weight", "Weight").output("psp", "Potential");
    }
    void update(forage::SynapseColumns& c) const { output(c); }
    void output(forage::SynapseColumns& c) const { c.state(1) = c.state(0) * c.pre(); }
};

FORAGE_PLUGIN(SilentOutput);
