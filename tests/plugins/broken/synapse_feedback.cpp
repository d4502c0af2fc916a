// A synapse that reads a feedback which it does not declare.
#include <forage/plugin.h>

struct Blind {
    static void describe(forage::SynapseSpec<Blind>& s) {
        s.name("synapseBlind", "Blind").doc("Broken on purpose.");
        s.output("psp", "Potential");
    }
    void update(forage::SynapseColumns& c) const { c.state(0) = c.pre() * c.feedback(0); }
};

FORAGE_PLUGIN(Blind);
