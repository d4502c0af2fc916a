// The same name as another plugin's, twice_a.cpp.
#include <forage/plugin.h>

struct TwiceAgain {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<TwiceAgain>& s) {
        s.name("neuronTwice", "Twice").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &TwiceAgain::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

FORAGE_PLUGIN(TwiceAgain);
