// Its constructor throws.
#include <stdexcept>

#include <forage/plugin.h>

struct ThrowingConstructor {
    double gain = 1;
    ThrowingConstructor() { throw std::runtime_error("no device"); }
    static void describe(forage::NeuronSpec<ThrowingConstructor>& s) {
        s.name("neuronThrowingConstructor", "ThrowingConstructor")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThrowingConstructor::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

FORAGE_PLUGIN(ThrowingConstructor);
