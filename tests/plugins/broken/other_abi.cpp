// Built with the old strings of libstdc++.
#include <forage/plugin.h>

struct OldStrings {
    double gain = 1;

    static void describe(forage::NeuronSpec<OldStrings>& s) {
        s.name("neuronOldStrings", "OldStrings")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &OldStrings::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

FORAGE_PLUGIN(OldStrings);
