// Uses a state that it does not declare.
#include <forage/plugin.h>

struct NoSuchState {
    double gain = 1;

    static void describe(forage::NeuronSpec<NoSuchState>& s) {
        s.name("neuronNoSuchState", "NoSuchState")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &NoSuchState::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(), c.state(4) = c.excitation(); }
};

FORAGE_PLUGIN(NoSuchState);
