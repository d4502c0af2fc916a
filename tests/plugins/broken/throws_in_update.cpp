// Throws in the 7th cycle.
#include <stdexcept>

#include <forage/plugin.h>

struct ThrowingUpdate {
    double gain = 1;

    static void describe(forage::NeuronSpec<ThrowingUpdate>& s) {
        s.name("neuronThrowingUpdate", "ThrowingUpdate")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThrowingUpdate::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const {
        if (c.cycle() == 7) throw std::runtime_error("out of range");
        c.state(0) = 1.0 + static_cast<double>(c.cycle());
    }
};

FORAGE_PLUGIN(ThrowingUpdate);
