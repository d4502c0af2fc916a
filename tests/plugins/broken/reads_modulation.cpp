#include <forage/plugin.h>

using namespace forage;

struct ReadsModulation {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<ReadsModulation>& s) {
        s.name("neuronReadsModulation", "Reads modulation")
            .reads(InputKind::excitatory)
            .output("act", &Cell::act, "Activity");
    }
    void update(Cell& cell, const Input& in) const { cell.act = in.excitation * (1 + in.modulation); }
};
FORAGE_PLUGIN(ReadsModulation);
