#include <forage/plugin.h>

using namespace forage;

struct AnotherEachTime {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<AnotherEachTime>& s) {
        s.name("neuronAnotherEachTime", "Another each time").output("act", &Cell::act, "Activity");
    }
    void update(Cell& cell, const Input&) const {
        static double shared = 0;
        cell.act = ++shared;
    }
};
FORAGE_PLUGIN(AnotherEachTime);
