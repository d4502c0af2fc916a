// A synapse that rests while its source is silent with its default parameter, and not with others.
#include <forage/plugin.h>

struct RestlessParameter {
    double rate = 0;
    static void describe(forage::SynapseSpec<RestlessParameter>& s) {
        s.name("synapseRestlessParameter", "Restless parameter").doc("Broken on purpose.");
        s.param("rate", &RestlessParameter::rate).range(0, 1).doc("Of what is forgotten.");
        s.state("weight", "Weight").output("psp", "Potential").event_driven();
    }
    void update(forage::SynapseColumns& c) const {
        c.state(0) -= rate * c.state(0);
        c.state(1) = c.state(0) * c.pre();
    }
};

FORAGE_PLUGIN(RestlessParameter);
