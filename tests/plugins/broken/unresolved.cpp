// Uses a function that nobody defines.
#include <forage/plugin.h>

namespace lab {
double calibrate(double value);
}

struct Unresolved {
    double gain = 1;

    static void describe(forage::NeuronSpec<Unresolved>& s) {
        s.name("neuronUnresolved", "Unresolved")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &Unresolved::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = lab::calibrate(gain) * c.excitation(); }
};

FORAGE_PLUGIN(Unresolved);
