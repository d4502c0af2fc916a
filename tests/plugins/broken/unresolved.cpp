// Uses a function that is not defined.
#include <forage/plugin.h>

namespace lab {
double calibrate(double value);
}

struct Unresolved {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<Unresolved>& s) {
        s.name("neuronUnresolved", "Unresolved")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &Unresolved::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = lab::calibrate(gain) * in.excitation; }
};

FORAGE_PLUGIN(Unresolved);
