#include <forage/plugin.h>

using namespace forage;

struct StaticSynapse {
    struct Synapse {
        double weight = 0;
    };
    static void describe(SynapseSpec<StaticSynapse>& s) {
        s.name("synapseStatic", "Static").state("weight", &Synapse::weight, "Weight").output("psp", "Output");
    }
    void update(Synapse& s) const {
        static double shared = 0;
        s.weight = ++shared;
    }
    double output(const Synapse& s) const { return s.weight; }
};
FORAGE_PLUGIN(StaticSynapse);
