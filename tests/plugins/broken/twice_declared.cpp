// One number of a cell that is declared as two states.
#include <forage/plugin.h>

struct TwiceDeclared {
    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<TwiceDeclared>& s) {
        s.name("neuronTwiceDeclared", "TwiceDeclared").doc("Broken on purpose.");
        s.state("vm", &Cell::act, "Potential").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input&) const { c.act = 1; }
};

FORAGE_PLUGIN(TwiceDeclared);
