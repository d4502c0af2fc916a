// The same name as another plugin's, twice_a.cpp.
#include <forage/plugin.h>

struct Twice {
    double gain = 1;

    static void describe(forage::NeuronSpec<Twice>& s) {
        s.name("neuronTwice", "Twice").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &Twice::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

FORAGE_PLUGIN(Twice);
