// One good type and one whose state is declared twice.
#include <forage/plugin.h>

struct Good {
    static void describe(forage::NeuronSpec<Good>& s) {
        s.name("neuronGood", "Good").doc("Passes on.").reads(forage::InputKind::excitatory);
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

struct Bad {
    static void describe(forage::NeuronSpec<Bad>& s) {
        s.name("neuronBad", "Bad").doc("Broken on purpose.");
        s.state("act", "Activity").output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.state(1) = 0; }
};

FORAGE_PLUGIN(Good, Bad);
