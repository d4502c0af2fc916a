// describe() throws what is not even an exception.
#include <forage/plugin.h>

struct ThrowingDescribe {
    double gain = 1;

    static void describe(forage::NeuronSpec<ThrowingDescribe>& s) {
        s.name("neuronThrowingDescribe", "ThrowingDescribe")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThrowingDescribe::gain).doc("Factor.");
        s.output("act", "Activity");
        throw 42;
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

FORAGE_PLUGIN(ThrowingDescribe);
