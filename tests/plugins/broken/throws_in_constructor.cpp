// Its constructor throws.
#include <stdexcept>

#include <forage/plugin.h>

struct ThrowingConstructor {
    double gain = 1;
    struct Cell {
        double act = 0;
    };

    ThrowingConstructor() { throw std::runtime_error("no device"); }
    static void describe(forage::NeuronSpec<ThrowingConstructor>& s) {
        s.name("neuronThrowingConstructor", "ThrowingConstructor")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThrowingConstructor::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

FORAGE_PLUGIN(ThrowingConstructor);
