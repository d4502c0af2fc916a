// A synapse that promises to rest while its source is silent, and fades.
#include <forage/plugin.h>

struct Restless {
    static void describe(forage::SynapseSpec<Restless>& s) {
        s.name("synapseRestless", "Restless").doc("Broken on purpose.");
        s.state("weight", "Weight").output("psp", "Potential").event_driven();
    }
    void update(forage::SynapseColumns& c) const {
        c.state(0) *= 0.99;
        c.state(1) = c.state(0) * c.pre();
    }
};

FORAGE_PLUGIN(Restless);
