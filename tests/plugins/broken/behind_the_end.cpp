// Writes beyond the end of its columns.
#include <forage/plugin.h>

struct BehindTheEnd {
    double gain = 1;

    static void describe(forage::NeuronSpec<BehindTheEnd>& s) {
        s.name("neuronBehindTheEnd", "BehindTheEnd")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &BehindTheEnd::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const {
        for (int i = 0; i < c.size() + 3; ++i) c.state(0).data()[i] = 1;
    }
};

FORAGE_PLUGIN(BehindTheEnd);
