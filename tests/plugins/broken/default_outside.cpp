#include <forage/plugin.h>

using namespace forage;

struct DefaultOutside {
    double rate = 5;
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<DefaultOutside>& s) {
        s.name("neuronDefaultOutside", "Default outside").output("act", &Cell::act, "Activity");
        s.param("rate", &DefaultOutside::rate).range(0, 1);
    }
    void update(Cell& cell, const Input&) const { cell.act = rate; }
};
FORAGE_PLUGIN(DefaultOutside);
