// A name that ships with Forage.
#include <forage/plugin.h>

struct Same {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<Same>& s) {
        s.name("neuronSame", "Same").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &Same::gain).doc("Factor.");
        s.name("neuronLinearThreshold", "Same");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = gain * in.excitation; }
};

FORAGE_PLUGIN(Same);
