// A name that ships with Forage.
#include <forage/plugin.h>

struct Same {
    double gain = 1;

    static void describe(forage::NeuronSpec<Same>& s) {
        s.name("neuronSame", "Same").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &Same::gain).doc("Factor.");
        s.name("neuronLinearThreshold", "Same");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = gain * c.excitation(); }
};

FORAGE_PLUGIN(Same);
