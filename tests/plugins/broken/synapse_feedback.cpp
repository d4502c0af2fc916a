// A synapse that reads a feedback which it does not declare.
#include <forage/plugin.h>

struct Blind {
    struct Target {
        double post = 0;
    };

    static void describe(forage::SynapseSpec<Blind>& s) {
        s.name("synapseBlind", "Blind").doc("Broken on purpose.");
        s.output("psp", "Potential");
    }
    double output(double pre, const Target& target) const { return pre * target.post; }
};

FORAGE_PLUGIN(Blind);
