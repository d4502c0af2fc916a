// Built with the old strings of libstdc++.
#include <forage/plugin.h>

struct OldStrings {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<OldStrings>& s) {
        s.name("neuronOldStrings", "OldStrings")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &OldStrings::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

FORAGE_PLUGIN(OldStrings);
