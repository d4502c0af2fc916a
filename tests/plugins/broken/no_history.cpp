// A state that is not kept.
#include <forage/plugin.h>

struct NoHistory {
    double gain = 1;

    static void describe(forage::NeuronSpec<NoHistory>& s) {
        s.name("neuronNoHistory", "NoHistory").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &NoHistory::gain).doc("Factor.");
        s.output("act", "Activity", 0);
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

FORAGE_PLUGIN(NoHistory);
