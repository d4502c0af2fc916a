#include <forage/plugin.h>

using namespace forage;

struct BlankName {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<BlankName>& s) {
        s.name("neuron Blank", "Blank").output("act", &Cell::act, "Activity");
    }
    void update(Cell&, const Input&) const {}
};
FORAGE_PLUGIN(BlankName);
