// A neuron that promises that its cells are independent, and compares each with the mean of all.
#include <forage/plugin.h>

struct Sociable {
    static void describe(forage::NeuronSpec<Sociable>& s) {
        s.name("neuronSociable", "Sociable").doc("Broken on purpose.");
        s.reads(forage::InputKind::excitatory);
        s.elementwise();
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const {
        auto [act] = c.states<1>();
        act = c.excitation() - c.excitation().mean();
    }
};

FORAGE_PLUGIN(Sociable);
