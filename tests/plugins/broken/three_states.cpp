// Uses three states and declares two.
#include <forage/plugin.h>

struct ThreeStates {
    double gain = 1;

    static void describe(forage::NeuronSpec<ThreeStates>& s) {
        s.name("neuronThreeStates", "ThreeStates")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThreeStates::gain).doc("Factor.");
        s.state("vm", "Potential").output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const {
        auto [vm, act, more] = c.states<3>();
        vm = c.excitation(), act = vm, more = vm;
    }
};

FORAGE_PLUGIN(ThreeStates);
