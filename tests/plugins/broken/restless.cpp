// A synapse that promises to be event driven, but fades while its source is silent.
#include <forage/plugin.h>

struct Restless {
    struct Synapse {
        double weight = 0;
    };

    static void describe(forage::SynapseSpec<Restless>& s) {
        s.name("synapseRestless", "Restless").doc("Broken on purpose.");
        s.state("weight", &Synapse::weight, "Weight").output("psp", "Potential").event_driven();
    }
    void update(Synapse& s, double) const { s.weight *= 0.99; }
    double output(const Synapse& s, double pre) const { return s.weight * pre; }
};

FORAGE_PLUGIN(Restless);
