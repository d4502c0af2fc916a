// A type whose update never returns.
#include <forage/plugin.h>

using namespace forage;

struct Endless {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<Endless>& s) {
        s.name("neuronEndless", "Endless").output("act", &Cell::act, "Activity");
    }
    void update(Cell& cell, const Input&) const {
        for (volatile bool on = true; on;) cell.act += 1;
    }
};
FORAGE_PLUGIN(Endless);
