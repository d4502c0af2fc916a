// The same name as another plugin's, twice_a.cpp.
#include <forage/plugin.h>

struct Twice {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<Twice>& s) {
        s.name("neuronTwice", "Twice").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &Twice::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

FORAGE_PLUGIN(Twice);
