// One good type and one whose state is declared twice.
#include <forage/plugin.h>

struct Good {
    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<Good>& s) {
        s.name("neuronGood", "Good").doc("Passes on.").reads(forage::InputKind::excitatory);
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

struct Bad {
    struct Cell {
        double vm = 0, act = 0;
    };

    static void describe(forage::NeuronSpec<Bad>& s) {
        s.name("neuronBad", "Bad").doc("Broken on purpose.");
        s.state("act", &Cell::vm, "Activity").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input&) const { c.act = c.vm = 0; }
};

FORAGE_PLUGIN(Good, Bad);
