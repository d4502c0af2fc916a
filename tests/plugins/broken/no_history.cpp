// A state that is not kept.
#include <forage/plugin.h>

struct NoHistory {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<NoHistory>& s) {
        s.name("neuronNoHistory", "NoHistory").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &NoHistory::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity", 0);
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

FORAGE_PLUGIN(NoHistory);
