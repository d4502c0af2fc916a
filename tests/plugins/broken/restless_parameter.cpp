// A synapse that is event driven with its default parameter, but not with other values.
#include <forage/plugin.h>

struct RestlessParameter {
    double rate = 0;

    struct Synapse {
        double weight = 0;
    };

    static void describe(forage::SynapseSpec<RestlessParameter>& s) {
        s.name("synapseRestlessParameter", "Restless parameter").doc("Broken on purpose.");
        s.param("rate", &RestlessParameter::rate).range(0, 1).doc("Of what is forgotten.");
        s.state("weight", &Synapse::weight, "Weight").output("psp", "Potential").event_driven();
    }
    void update(Synapse& s, double) const { s.weight -= rate * s.weight; }
    double output(const Synapse& s, double pre) const { return s.weight * pre; }
};

FORAGE_PLUGIN(RestlessParameter);
