// A synapse that promises to be event driven, but whose output is its weight while its source is silent.
#include <forage/plugin.h>

struct RestlessOutput {
    struct Synapse {
        double weight = 0;
    };

    static void describe(forage::SynapseSpec<RestlessOutput>& s) {
        s.name("synapseRestlessOutput", "Restless output").doc("Broken on purpose.");
        s.state("weight", &Synapse::weight, "Weight").output("psp", "Potential").event_driven();
    }
    void update(Synapse& s, double pre) const { s.weight += 0.1 * pre; }
    double output(const Synapse& s, double) const { return s.weight; }
};

FORAGE_PLUGIN(RestlessOutput);
